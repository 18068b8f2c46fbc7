#include "app/draw/figure/figure.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

struct PressRun {
  Scene scene;
  std::vector<Sample> samples;
};

PressRun run_press(const char* algorithm) {
  PressRun run;
  run.scene = file::load_scene("press")->scene;
  run.scene.algorithm.index = *find_algorithm(algorithm);
  run.scene.duration_s = 3.0;
  run.samples = testing::samples_of(run.scene);
  return run;
}

// Hides the display for the lifetime of the object.
class NoDisplay {
 public:
  NoDisplay() {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
      const char* value = std::getenv(name);
      saved_.emplace_back(name, value != nullptr ? value : "");
      unsetenv(name);
    }
  }
  NoDisplay(const NoDisplay&) = delete;
  NoDisplay& operator=(const NoDisplay&) = delete;
  ~NoDisplay() {
    for (const auto& [name, value] : saved_) {
      if (!value.empty()) setenv(name.c_str(), value.c_str(), 1);
    }
  }

 private:
  std::vector<std::pair<std::string, std::string>> saved_;
};

// The page has the four plots below each other; each line's colour is in its own plot, beyond the
// few pixels of the legend.
void expect_lines_of_four_plots(const file::Picture& figure) {
  ASSERT_EQ(figure.width, 1600);
  ASSERT_EQ(figure.height, 1200);
  ASSERT_EQ(figure.rgba.size(), 4U * 1600U * 1200U);

  constexpr int kTitle = 90;
  constexpr int kPlot = (1200 - kTitle) / 4;
  constexpr int kLegend = 40;
  constexpr int kEnoughPixels = 80;
  const auto count = [&](Tone tone, int row) {
    const ImVec4 colour = theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)];
    const int top = kTitle + row * kPlot;
    return test::count_pixels(figure, test::colour_of(colour), 0, top + kLegend, 1600, top + kPlot);
  };
  EXPECT_GT(count(Tone::kPosition, 0), kEnoughPixels);
  EXPECT_GT(count(Tone::kHand, 0), kEnoughPixels);
  EXPECT_GT(count(Tone::kWall, 0), kEnoughPixels);
  EXPECT_GT(count(Tone::kForce, 1), kEnoughPixels);
  EXPECT_GT(count(Tone::kWallForce, 1), kEnoughPixels);
  EXPECT_GT(count(Tone::kStiffness, 2), kEnoughPixels);
  EXPECT_GT(count(Tone::kObserver, 3), kEnoughPixels);
  EXPECT_GT(count(Tone::kHold, 3), kEnoughPixels);
  EXPECT_GT(count(Tone::kScv, 3), kEnoughPixels);
  EXPECT_GT(count(Tone::kBudget, 3), kEnoughPixels);
  EXPECT_LT(count(Tone::kHold, 0), kEnoughPixels);  // the colours do tell the plots apart
}

TEST(Figure, ShowsTheLinesOfAllFourPlotsWithoutADisplay) {
  const NoDisplay no_display;
  const PressRun run = run_press("none");
  const Result<file::Picture> figure = draw_figure(run.scene, run.samples);
  ASSERT_TRUE(figure.ok()) << figure.error().message;
  expect_lines_of_four_plots(*figure);
}

TEST(Figure, ShowsTheLinesOfAllFourPlotsInVectorFiles) {
  if (!test::can_draw_vector_files()) GTEST_SKIP() << test::kNoPrograms;
  const PressRun run = run_press("none");
  const auto draw = [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); };
  for (const char* ending : {".svg", ".pdf"})
    expect_lines_of_four_plots(test::FigureFile(draw, ending).drawn());
}

TEST(Figure, IsTheSameEveryTimeAndDependsOnTheRun) {
  const PressRun none = run_press("none");
  const PressRun bounded = run_press("energy-bounding");
  constexpr FigureSize kSize{800, 600};
  const auto first = draw_figure(none.scene, none.samples, kSize);
  const auto second = draw_figure(none.scene, none.samples, kSize);
  const auto other = draw_figure(bounded.scene, bounded.samples, kSize);
  ASSERT_TRUE(first.ok() && second.ok() && other.ok());
  EXPECT_EQ(first->rgba, second->rgba);
  EXPECT_NE(first->rgba, other->rgba);
}

TEST(Figure, APageWithoutSamplesIsDrawn) {
  const auto figure = draw_figure(file::load_scene("press")->scene, {}, {640, 480});
  ASSERT_TRUE(figure.ok());
  EXPECT_GT(test::count_pixels(*figure, {255, 255, 255}, 0, 0, 640, 480), 640 * 480 / 2);
}

TEST(Figure, RefusesASizeThatIsNone) {
  for (const FigureSize size : {FigureSize{0, 600}, FigureSize{800, -1}, FigureSize{800, 100000}}) {
    const auto figure = draw_figure(file::load_scene("press")->scene, {}, size);
    ASSERT_FALSE(figure.ok());
    EXPECT_NE(figure.error().message.find("pixels"), std::string::npos);
  }
}

TEST(Figure, GoesIntoAPngOfItsSize) {
  const PressRun run = run_press("virtual-coupling");
  const auto figure = draw_figure(run.scene, run.samples, {900, 700});
  ASSERT_TRUE(figure.ok());
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) / "hapticwall_figure_test.png";
  ASSERT_FALSE(file::write_png(path, *figure));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0);
  EXPECT_EQ(image.width, 900U);
  EXPECT_EQ(image.height, 700U);
  png_image_free(&image);
  std::filesystem::remove(path);
}

TEST(Figure, IsTheSameInVectorFiles) {
  const PressRun run = run_press("energy-bounding");
  test::expect_same_in_vector_files(
      [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); });
}

// Two figures stand in one file, like those of both axes of a scene.
TEST(Figure, TwoOfThemStandBesideEachOtherInVectorFiles) {
  const PressRun none = run_press("none");
  const PressRun bounded = run_press("energy-bounding");
  test::expect_same_in_vector_files([&](Ink ink) -> Result<file::Picture> {
    const FigureSize size{640, 480, ink};
    const auto left = draw_figure(none.scene, none.samples, size);
    const auto right = draw_figure(bounded.scene, bounded.samples, size);
    if (!left || !right) return left ? right : left;
    return file::beside(*left, *right);
  });
}

TEST(Figure, VectorFilesAreSmallAndHoldNoPixels) {
  constexpr std::size_t kMaxBytes = 500'000;
  const PressRun run = run_press("none");
  for (const char* ending : {".svg", ".pdf"}) {
    const test::FigureFile figure(
        [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); }, ending);
    EXPECT_LT(figure.bytes().size(), kMaxBytes) << ending;
    EXPECT_EQ(figure.bytes().find("<image"), std::string::npos) << ending;
    EXPECT_EQ(figure.bytes().find("/CreationDate"), std::string::npos) << ending;
    EXPECT_EQ(figure.bytes().find("/Subtype /Image"), std::string::npos) << ending;
  }
}

TEST(Figure, ItsTextStaysTextInAPdf) {
  if (std::system("command -v pdftotext >/dev/null") != 0) GTEST_SKIP() << "there is no pdftotext";
  const PressRun run = run_press("none");
  const test::FigureFile pdf(
      [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); }, ".pdf");
  const std::string text = pdf.passed_through("f() { pdftotext \"$1\" -; }; f");
  for (const char* words : {"handle 50 g, 1 N·s/m", "(b) Force", "force / penetration"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

}  // namespace
}  // namespace hapticwall::draw
