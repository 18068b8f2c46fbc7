#include "app/draw/figure/comparison_figure.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "app/draw/plot/theme.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"

namespace hapticwall::draw {
namespace {

constexpr FigureSize kSmall{1200, 700};

Scene press() {
  Scene scene = file::load_scene("press")->scene;
  scene.duration_s = 3.0;
  return scene;
}

ComparedRun run(Scene scene, const char* algorithm) {
  scene.algorithm.index = *find_algorithm(algorithm);
  SampleHistory history(scene.tick_count(), scene.x().device.encoder_m);
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { history.push(sample); };
  Summary summary = simulate(scene, options).summary;
  return {std::move(summary), std::move(history)};
}

// Pixels of a tone in one of four rows of plots, in the columns [from, to) of pixels; less the
// heading of the row.
int count(const file::Picture& figure, Tone tone, int row, int from, int to, int tolerance = 24) {
  const int head = figure.height / 6;
  const int each = (figure.height - head) / 4;
  const int legend = figure.height / 24;
  const int top = head + row * each;
  const ImVec4 colour = theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)];
  return test::count_pixels(figure, test::colour_of(colour), from, top + legend, to, top + each,
                            tolerance);
}

bool half_is_white(const file::Picture& figure) {
  return test::count_pixels(figure, {255, 255, 255}, 0, 0, figure.width, figure.height) >
         figure.width * figure.height / 2;
}

TEST(ComparisonFigure, HasEachOfItsLinesInTheColumnOfEveryAlgorithm) {
  std::vector<ComparedRun> runs;
  for (const AlgorithmDescription& algorithm : algorithms()) {
    runs.push_back(run(press(), std::string(algorithm.name).c_str()));
  }
  const FigureSize size = comparison_size(runs.size());
  const auto figure = draw_comparison(press(), runs, size);
  ASSERT_TRUE(figure.ok()) << figure.error().message;
  ASSERT_EQ(figure->width, 2400);
  ASSERT_EQ(figure->height, 1400);
  constexpr int kEnoughPixels = 40;
  const int columns = static_cast<int>(runs.size());
  for (int column = 0; column < columns; ++column) {
    const int from = figure->width * column / columns;
    const int to = figure->width * (column + 1) / columns;
    // A flat line falls between two rows of pixels. The quotient of means is all flat and takes no
    // more than two thirds of each; white and the grid are twice as far from its colour.
    constexpr int kBlurred = 60;
    constexpr int kBetweenRows = 100;
    const auto pixels = [&](Tone tone, int row) {
      const int tolerance = tone == Tone::kStiffness ? kBetweenRows : kBlurred;
      return count(*figure, tone, row, from, to, tolerance);
    };
    EXPECT_GT(pixels(Tone::kPosition, 0), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kHand, 0), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kWall, 0), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kForce, 1), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kStiffness, 2), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kObserver, 3), kEnoughPixels) << column;
    EXPECT_LT(pixels(Tone::kObserver, 1), kEnoughPixels) << column;
  }
}

// tests/app/ui/page/all_page_test.cpp expects the same of the window.
TEST(ComparisonFigure, AVerdictHasTheColourOfItsGrade) {
  constexpr int kBlurred = 60;  // thin strokes
  constexpr std::array kVerdicts{Verdict::kSettled, Verdict::kBuzzing, Verdict::kOscillating};
  const auto pixels = [&](Verdict verdict, Tone tone) {
    ComparedRun shown = run(press(), "none");
    shown.summary.verdict = verdict;
    const auto figure = draw_comparison(press(), std::vector{shown}, kSmall);
    EXPECT_TRUE(figure.ok());
    const ImVec4 colour = theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)];
    return test::count_pixels(*figure, test::colour_of(colour), 0, 0, figure->width,
                              figure->height / 6, kBlurred);
  };
  for (const Verdict verdict : kVerdicts) {
    for (const Verdict other : kVerdicts) {
      const Tone tone = verdict_tone(verdict);
      if (tone == verdict_tone(other)) continue;
      EXPECT_GT(pixels(verdict, tone), pixels(other, tone)) << verdict_name(verdict);
    }
  }
}

// Beside a wall that shakes, the same quiet one is drawn as low as the shared axis has it.
TEST(ComparisonFigure, SharesTheAxesOfARow) {
  const ComparedRun quiet = run(press(), "virtual-coupling");
  const ComparedRun shaking = run(press(), "none");
  const auto two_quiet = draw_comparison(press(), std::vector{quiet, quiet}, kSmall);
  const auto both = draw_comparison(press(), std::vector{quiet, shaking}, kSmall);
  ASSERT_TRUE(two_quiet.ok() && both.ok());
  const int half = kSmall.width / 2;
  // The pixels of the left plots of energy: spread over the height, or flat.
  constexpr int kEnergyRow = 3;
  const int spread = count(*two_quiet, Tone::kBudget, kEnergyRow, 0, half);
  const int flat = count(*both, Tone::kBudget, kEnergyRow, 0, half);
  EXPECT_GT(spread, 2 * flat);
}

TEST(ComparisonFigure, ARunThatDivergedDoesNotStretchTheAxesOfOthers) {
  const ComparedRun quiet = run(press(), "virtual-coupling");
  Scene scene = press();
  scene.x().walls.front().damping_n_s_per_m = 1e4;
  scene.x().device.encoder_m.reset();
  scene.x().device.force_limit_n.reset();
  const ComparedRun diverged = run(scene, "none");
  ASSERT_EQ(diverged.summary.verdict, Verdict::kDiverged);
  const auto alone = draw_comparison(press(), std::vector{quiet, quiet}, kSmall);
  const auto beside = draw_comparison(press(), std::vector{quiet, diverged}, kSmall);
  ASSERT_TRUE(alone.ok() && beside.ok());
  const int half = kSmall.width / 2;
  for (int row = 0; row < 4; ++row) {
    for (const Tone tone : {Tone::kPosition, Tone::kForce, Tone::kStiffness, Tone::kBudget}) {
      EXPECT_EQ(count(*alone, tone, row, 0, half - 10), count(*beside, tone, row, 0, half - 10));
    }
  }
  // Alone it has axes of its own.
  EXPECT_TRUE(draw_comparison(press(), std::vector{diverged}, kSmall).ok());
}

TEST(ComparisonFigure, IsTheSameEveryTimeAndDependsOnTheOrder) {
  const ComparedRun a = run(press(), "none");
  const ComparedRun b = run(press(), "energy-bounding");
  const auto first = draw_comparison(press(), std::vector{a, b}, kSmall);
  const auto second = draw_comparison(press(), std::vector{a, b}, kSmall);
  const auto other = draw_comparison(press(), std::vector{b, a}, kSmall);
  ASSERT_TRUE(first.ok() && second.ok() && other.ok());
  EXPECT_EQ(first->rgba, second->rgba);
  EXPECT_NE(first->rgba, other->rgba);
}

TEST(ComparisonFigure, SaysWhichAxisItIsOf) {
  const std::vector<ComparedRun> runs{run(press(), "none")};
  Scene corner = press();
  corner.axes.push_back(file::load_scene("corner")->scene.axes.at(1));
  const auto one_axis = draw_comparison(press(), runs, kSmall);
  const auto two_axes = draw_comparison(corner, runs, kSmall);
  ASSERT_TRUE(one_axis.ok() && two_axes.ok());
  EXPECT_NE(one_axis->rgba, two_axes->rgba);
}

TEST(ComparisonFigure, NamesWhatFollowsInItsTitleAlone) {
  std::vector<ComparedRun> runs{run(press(), "none")};
  const auto short_name = draw_comparison(press(), runs, kSmall);
  runs.front().summary.algorithm = "none then passivity-control";
  const auto long_name = draw_comparison(press(), runs, kSmall);
  Scene followed = press();
  followed.algorithm.values.at(*find_algorithm_parameter("then")) = 1.0;
  const auto title = draw_comparison(followed, runs, kSmall);
  ASSERT_TRUE(short_name.ok() && long_name.ok() && title.ok());
  EXPECT_EQ(short_name->rgba, long_name->rgba);
  EXPECT_NE(short_name->rgba, title->rgba);
}

TEST(ComparisonFigure, APageWithoutRunsIsDrawn) {
  const auto none = draw_comparison(press(), {}, kSmall);
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(half_is_white(*none));
  const std::vector<ComparedRun> empty{{Summary{}, SampleHistory(1)}};
  const auto no_samples = draw_comparison(press(), empty, kSmall);
  ASSERT_TRUE(no_samples.ok());
  EXPECT_TRUE(half_is_white(*no_samples));
}

TEST(ComparisonFigure, GrowsWithItsColumns) {
  EXPECT_EQ(comparison_size(1).width, comparison_size(8).width);
  EXPECT_GT(comparison_size(kMaxComparedRuns).width, comparison_size(8).width);
  const std::vector<ComparedRun> runs(kMaxComparedRuns, run(press(), "force-bounding"));
  EXPECT_TRUE(draw_comparison(press(), runs, comparison_size(runs.size())).ok());
}

TEST(ComparisonFigure, RefusesASizeThatIsNone) {
  EXPECT_FALSE(draw_comparison(press(), {}, {0, 600}).ok());
}

TEST(ComparisonFigure, IsTheSameInVectorFiles) {
  std::vector<ComparedRun> runs;
  for (const char* name : {"energy-bounding", "none"}) runs.push_back(run(press(), name));
  test::expect_same_in_vector_files(
      [&](Ink ink) { return draw_comparison(press(), runs, kSmall.in(ink)); });
}

}  // namespace
}  // namespace hapticwall::draw
