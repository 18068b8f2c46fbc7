// A film of `press`: chatter is seen, a quiet wall stands still, and the scales never move.
#include "app/draw/film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

constexpr double kFromS = 3.0;
constexpr double kToS = 3.1;

FilmRun run_of(const Scene& scene) {
  FilmRun run{{{0, scene, "law"}}, SampleHistory(scene.tick_count(), scene.x().device.encoder_m)};
  run.history.push(testing::samples_of(scene));
  return run;
}

FilmRun press_under(const char* algorithm) {
  Scene scene = file::load_scene("press")->scene;
  scene.algorithm.index = *find_algorithm(algorithm);
  scene.duration_s = kToS;
  return run_of(scene);
}

FilmSettings short_film() {
  FilmSettings settings;
  settings.size = {640, 360};
  settings.slow = 2.0;
  settings.from_s = kFromS;
  settings.to_s = kToS;
  return settings;
}

std::vector<file::Picture> pictures(std::vector<FilmRun> runs, const FilmSettings& settings,
                                    std::uint64_t count) {
  Film film(std::move(runs), settings);
  std::vector<file::Picture> all;
  for (std::uint64_t i = 0; i < count; ++i) {
    Result<file::Picture> picture = film.draw(i);
    EXPECT_TRUE(picture);
    if (picture) all.push_back(std::move(*picture));
  }
  return all;
}

// A part of a picture in shares of its width and height.
struct Part {
  double left, top, right, bottom;
};
// Wall and contact of the left and of the right card of two.
constexpr Part kLeftWall{0.03, 0.32, 0.49, 0.63};
constexpr Part kRightWall{0.51, 0.32, 0.97, 0.63};

// Pixels of the part that differ clearly.
int changed(const file::Picture& a, const file::Picture& b, const Part& part) {
  constexpr int kClearly = 40;
  int count = 0;
  for (int y = static_cast<int>(part.top * a.height); y < static_cast<int>(part.bottom * a.height);
       ++y) {
    for (int x = static_cast<int>(part.left * a.width); x < static_cast<int>(part.right * a.width);
         ++x) {
      const auto at = static_cast<std::size_t>(4 * (y * a.width + x));
      int most = 0;
      for (std::size_t i = at; i < at + 3; ++i)
        most = std::max(most, std::abs(int{a.rgba.at(i)} - int{b.rgba.at(i)}));
      count += most > kClearly ? 1 : 0;
    }
  }
  return count;
}

TEST(Film, ShowsChatterBesideAQuietWall) {
  std::vector<FilmRun> runs;
  runs.push_back(press_under("none"));
  runs.push_back(press_under("energy-bounding"));
  const auto film = pictures(std::move(runs), short_film(), 4);
  ASSERT_EQ(film.size(), 4U);
  int chatter = 0;
  int quiet = 0;
  for (std::size_t i = 1; i < film.size(); ++i) {
    chatter = std::max(chatter, changed(film[i - 1], film[i], kLeftWall));
    quiet = std::max(quiet, changed(film[i - 1], film[i], kRightWall));
  }
  EXPECT_GT(chatter, 500) << "pixels, of 640 x 360";
  EXPECT_LT(10 * quiet, chatter);
}

TEST(Film, HasTheSamePixelsTwice) {
  const auto once = [] {
    std::vector<FilmRun> runs;
    runs.push_back(press_under("none"));
    return pictures(std::move(runs), short_film(), 3);
  };
  const auto first = once();
  const auto second = once();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].rgba, second[i].rgba) << i;
  EXPECT_NE(first[0].rgba, first[1].rgba);
}

TEST(Film, HasTheSizeAndTheLookThatItIsAskedFor) {
  FilmSettings settings = short_film();
  settings.size = {300, 400};
  const auto corner = [&](Look look) {
    settings.look = look;
    std::vector<FilmRun> runs;
    runs.push_back(press_under("none"));
    const auto film = pictures(std::move(runs), settings, 1);
    EXPECT_EQ(film.at(0).width, 300);
    EXPECT_EQ(film.at(0).height, 400);
    return static_cast<int>(film.at(0).rgba.at(0));
  };
  EXPECT_LT(corner(Look::kScreen), 60);
  EXPECT_GT(corner(Look::kLight), 200);
}

TEST(FilmSettings, CountPicturesOfTheSessionAndOfSlowMotion) {
  FilmSettings settings;
  settings.to_s = 6.0;
  EXPECT_EQ(settings.picture_count(), 360.0);
  settings.slow = 10.0;
  EXPECT_EQ(settings.picture_count(), 3600.0);
  settings.from_s = 5.6;
  settings.to_s = 5.8;
  settings.slow = 20.0;
  settings.rate_hz = 20.0;
  EXPECT_EQ(settings.picture_count(), 80.0) << "no picture more by rounding";
  settings.to_s = 5.6001;
  EXPECT_EQ(settings.picture_count(), 1.0);
}

TEST(FilmScales, HoldEveryRunAndStandStill) {
  std::vector<FilmRun> runs;
  runs.push_back(press_under("none"));
  runs.push_back(press_under("energy-bounding"));
  const FilmScales scales = film_scales(runs, kFromS, kToS);
  EXPECT_EQ(scales.face_m, 0.05);
  const IndexRange range = runs[0].history.range_within(kFromS, kToS);
  const Extremes shaken = runs[0].history.extremes(&PlantTruth::position_m, range);
  EXPECT_LT(scales.contact_m.minimum, shaken.minimum);
  EXPECT_GT(scales.contact_m.maximum, shaken.maximum);
  const double shown_m = scales.contact_m.maximum - scales.contact_m.minimum;
  EXPECT_GT(shaken.maximum - shaken.minimum, 0.4 * shown_m) << "chatter is the picture";
  EXPECT_GT(scales.force_n.maximum, 8.9) << "the mark of the force limit";
  EXPECT_LT(scales.view_m.minimum, shaken.minimum);
}

TEST(FilmMoment, SweepsWhatWasSinceTheLastPicture) {
  std::vector<FilmRun> runs;
  runs.push_back(press_under("none"));
  const FilmScales scales = film_scales(runs, kFromS, kToS);
  const FilmMoment moment = moment_of(runs.front(), scales, kFromS, kFromS + 0.02);
  const Reach& reach = moment.picture.handle_reach_m;
  EXPECT_NEAR(reach.below.x + reach.above.x, 2.8e-3, 0.2e-3) << "a whole period of 50 Hz";
  const FilmMoment next = moment_of(runs.front(), scales, kFromS + 0.0195, kFromS + 0.02);
  EXPECT_EQ(next.picture.handle_reach_m, Reach{}) << "one tick alone";
  EXPECT_EQ(moment.tail.summary.verdict, Verdict::kOscillating);
  EXPECT_EQ(moment.tone(), Tone::kBad);
}

TEST(FilmMoment, HasTheSceneOfItsTick) {
  FilmRun run = press_under("none");
  Scene soft = run.scenes.front().scene;
  soft.x().walls.front().stiffness_n_per_m = 100.0;
  run.scenes.push_back({3050, soft, "soft"});
  EXPECT_EQ(run.at(3049).name, "law");
  EXPECT_EQ(run.at(3050).name, "soft");
  const std::vector<FilmRun> runs{run};
  const FilmScales scales = film_scales(runs, kFromS, kToS);
  const FilmMoment before = moment_of(run, scales, 3.04, 3.0495);
  const FilmMoment after = moment_of(run, scales, 3.05, 3.0505);
  EXPECT_EQ(before.picture.walls.front().stiffness_n_per_m, 35000.0);
  EXPECT_EQ(after.picture.walls.front().stiffness_n_per_m, 100.0);
}

}  // namespace
}  // namespace hapticwall::draw
