#include "app/draw/figure/comparison_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/theme.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/draw/figure/page_texts.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"

namespace hapticwall::draw {
namespace {

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

// A comparison as pixels, with the places of its plots.
class Drawn {
 public:
  Drawn(const Scene& scene, std::span<const ComparedRun> runs, double width_mm = kDoubleWidthMm) {
    const auto pixels = draw_comparison(scene, runs, {width_mm});
    const auto shapes = draw_comparison(scene, runs, {width_mm, Ink::kShapes});
    EXPECT_TRUE(pixels.ok() && shapes.ok());
    if (!pixels.ok() || !shapes.ok()) return;
    pixels_ = *pixels;
    shapes_ = *shapes;
    for (const file::DrawnText& text : test::texts_of(shapes_)) {
      if (text.text.starts_with("time")) feet_.push_back(text.ink);
      for (const ComparedRun& run : runs)
        if (text.text == run.summary.algorithm) heads_.push_back(text.ink);
    }
  }
  [[nodiscard]] const file::Picture& pixels() const { return pixels_; }
  [[nodiscard]] const file::Picture& shapes() const { return shapes_; }

  // The plot of a run in one of four rows. Each run has its name above and the title of the time
  // axis below its plots.
  [[nodiscard]] test::PixelArea plot(std::size_t run, int row) const {
    constexpr double kHeading = 110.0;  // pixels from the name to the plots: three or four lines
    constexpr double kTimeAxis = 45.0;  // pixels from the plots to the title
    const cairo_rectangle_t& head = heads_.at(run);
    const cairo_rectangle_t& foot = feet_.at(run);
    const double top = head.y + kHeading;
    const double each = (foot.y - kTimeAxis - top) / 4.0;
    const double right = 2.0 * (foot.x + 0.5 * foot.width) - head.x;
    return {static_cast<int>(head.x), static_cast<int>(top + row * each), static_cast<int>(right),
            static_cast<int>(top + (row + 1) * each)};
  }
  // Pixels of a tone in it.
  [[nodiscard]] int count(Tone tone, std::size_t run, int row, int tolerance = 24) const {
    const test::PixelArea area = plot(run, row);
    return test::count_pixels(pixels_, colour_of(tone), area.left, area.top, area.right,
                              area.bottom, tolerance);
  }
  // Their mean height, 0 at the bottom of the plot to 1.
  [[nodiscard]] double height_of(Tone tone, std::size_t run, int row) const {
    const test::PixelArea area = plot(run, row);
    double sum = 0.0;
    int pixels = 0;
    for (int y = area.top; y < area.bottom; ++y) {
      const int here =
          test::count_pixels(pixels_, colour_of(tone), area.left, y, area.right, y + 1, 60);
      sum += static_cast<double>(here) * (area.bottom - y);
      pixels += here;
    }
    return sum / std::max(pixels, 1) / (area.bottom - area.top);
  }

 private:
  [[nodiscard]] static test::Colour colour_of(Tone tone) {
    return test::colour_of(theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)]);
  }

  file::Picture pixels_;
  file::Picture shapes_;
  std::vector<cairo_rectangle_t> heads_;
  std::vector<cairo_rectangle_t> feet_;
};

bool half_is_white(const file::Picture& figure) {
  return test::count_pixels(figure, {255, 255, 255}, 0, 0, figure.width, figure.height) >
         figure.width * figure.height / 2;
}

TEST(ComparisonFigure, HasEachOfItsLinesInTheColumnOfEveryAlgorithm) {
  std::vector<ComparedRun> runs;
  for (const AlgorithmDescription& algorithm : algorithms()) {
    runs.push_back(run(press(), std::string(algorithm.name).c_str()));
  }
  const Drawn figure(press(), runs);
  constexpr int kEnoughPixels = 40;
  for (std::size_t column = 0; column < runs.size(); ++column) {
    // A flat line falls between two rows of pixels. The quotient of means is all flat and takes no
    // more than two thirds of each; white and the grid are twice as far from its colour.
    constexpr int kBlurred = 60;
    constexpr int kBetweenRows = 100;
    const auto pixels = [&](Tone tone, int row) {
      return figure.count(tone, column, row, tone == Tone::kStiffness ? kBetweenRows : kBlurred);
    };
    EXPECT_GT(pixels(Tone::kPosition, 0), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kHand, 0), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kWall, 0), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kForce, 1), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kStiffness, 2), kEnoughPixels) << column;
    EXPECT_GT(pixels(Tone::kObserver, 3), kEnoughPixels) << column;
    EXPECT_LT(pixels(Tone::kObserver, 1), 2 * kEnoughPixels) << column << ": subscripts' edges";
  }
}

TEST(ComparisonFigure, HasAtMostFourColumnsAndOnlyTheChosenRuns) {
  EXPECT_EQ(compared_columns({}, 1), 1U);
  EXPECT_EQ(compared_columns({}, 3), 3U);
  EXPECT_EQ(compared_columns({}, 16), 4U);
  EXPECT_EQ(compared_columns({kSingleWidthMm}, 16), 2U);
  const std::vector<ComparedRun> runs{run(press(), "none"), run(press(), "half-sample")};
  const std::string texts = test::all_texts(Drawn(press(), runs).shapes());
  for (const AlgorithmDescription& algorithm : algorithms()) {
    const bool chosen = algorithm.name == "none" || algorithm.name == "half-sample";
    EXPECT_EQ(texts.find("\n" + std::string(algorithm.name) + "\n") != std::string::npos, chosen)
        << algorithm.name;
  }
}

// A linear axis for 1000 mJ would draw 1 mJ as a line of zero.
TEST(ComparisonFigure, TheAxisOfEnergyShowsTheSettledRunsToo) {
  EXPECT_EQ(comparison_knee({}), 0.0);
  EXPECT_EQ(comparison_knee(std::array{10.0, 100.0}), 0.0) << "both are seen";
  EXPECT_DOUBLE_EQ(comparison_knee(std::array{2.0, 1000.0}), 0.1);
  EXPECT_DOUBLE_EQ(comparison_knee(std::array{1000.0, 0.0}), 1e-3) << "zero has no decade";
  const std::vector<ComparedRun> runs{run(press(), "virtual-coupling"), run(press(), "none")};
  const Drawn figure(press(), runs);
  const std::string texts = test::all_texts(figure.shapes());
  EXPECT_NE(texts.find("logarithmic beyond"), std::string::npos);
  // The observer of the quiet run leaves the line of zero by a good part of the plot.
  const std::vector<ComparedRun> alone{runs.front(), runs.front()};
  EXPECT_GT(figure.count(Tone::kObserver, 0, 3),
            Drawn(press(), alone).count(Tone::kObserver, 0, 3) / 2);
}

// tests/app/ui/page/all_page_test.cpp expects the same of the window.
TEST(ComparisonFigure, AVerdictHasTheColourOfItsGrade) {
  constexpr int kBlurred = 60;  // thin strokes
  constexpr std::array kVerdicts{Verdict::kSettled, Verdict::kBuzzing, Verdict::kOscillating};
  const auto pixels = [&](Verdict verdict, Tone tone) {
    ComparedRun shown = run(press(), "none");
    shown.summary.verdict = verdict;
    const auto figure = draw_comparison(press(), std::vector{shown});
    EXPECT_TRUE(figure.ok());
    const ImVec4 colour = theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)];
    return test::count_pixels(*figure, test::colour_of(colour), 0, 0, figure->width,
                              figure->height / 3, kBlurred);
  };
  for (const Verdict verdict : kVerdicts) {
    for (const Verdict other : kVerdicts) {
      const Tone tone = verdict_tone(verdict);
      if (tone == verdict_tone(other)) continue;
      EXPECT_GT(pixels(verdict, tone), pixels(other, tone)) << verdict_name(verdict);
    }
  }
}

// Beside a stiff wall, the same soft one is drawn as low as the shared axis has it.
TEST(ComparisonFigure, SharesTheAxesOfARow) {
  constexpr int kStiffnessRow = 2;
  const ComparedRun soft = run(press(), "virtual-coupling");
  const ComparedRun stiff = run(press(), "energy-bounding");
  const Drawn alone(press(), std::vector{soft, soft});
  const Drawn both(press(), std::vector{soft, stiff});
  const double own = alone.height_of(Tone::kStiffness, 0, kStiffnessRow);
  const double shared = both.height_of(Tone::kStiffness, 0, kStiffnessRow);
  EXPECT_GT(shared, 0.0);
  EXPECT_GT(own, shared + 0.3);
}

TEST(ComparisonFigure, ARunThatDivergedDoesNotStretchTheAxesOfOthers) {
  const ComparedRun quiet = run(press(), "virtual-coupling");
  Scene scene = press();
  scene.x().walls.front().damping_n_s_per_m = 1e4;
  scene.x().device.encoder_m.reset();
  scene.x().device.force_limit_n.reset();
  const ComparedRun diverged = run(scene, "none");
  ASSERT_EQ(diverged.summary.verdict, Verdict::kDiverged);
  const Drawn alone(press(), std::vector{quiet, quiet});
  const Drawn beside(press(), std::vector{quiet, diverged});
  for (int row = 0; row < 4; ++row) {
    for (const Tone tone : {Tone::kPosition, Tone::kForce, Tone::kStiffness, Tone::kBudget})
      EXPECT_EQ(alone.count(tone, 0, row), beside.count(tone, 0, row)) << row;
  }
  // Alone it has axes of its own.
  EXPECT_TRUE(draw_comparison(press(), std::vector{diverged}).ok());
}

TEST(ComparisonFigure, IsTheSameEveryTimeAndDependsOnTheOrder) {
  const ComparedRun a = run(press(), "none");
  const ComparedRun b = run(press(), "energy-bounding");
  const auto first = draw_comparison(press(), std::vector{a, b});
  const auto second = draw_comparison(press(), std::vector{a, b});
  const auto other = draw_comparison(press(), std::vector{b, a});
  ASSERT_TRUE(first.ok() && second.ok() && other.ok());
  EXPECT_EQ(first->rgba, second->rgba);
  EXPECT_NE(first->rgba, other->rgba);
}

TEST(ComparisonFigure, SaysWhichAxisItIsOf) {
  const std::vector<ComparedRun> runs{run(press(), "none")};
  Scene corner = press();
  corner.axes.push_back(file::load_scene("corner")->scene.axes.at(1));
  const auto one_axis = draw_comparison(press(), runs);
  const auto two_axes = draw_comparison(corner, runs);
  ASSERT_TRUE(one_axis.ok() && two_axes.ok());
  EXPECT_NE(one_axis->rgba, two_axes->rgba);
}

TEST(ComparisonFigure, NamesWhatFollowsInItsTitleAlone) {
  std::vector<ComparedRun> runs{run(press(), "none")};
  const auto short_name = draw_comparison(press(), runs);
  runs.front().summary.algorithm = "none then passivity-control";
  const auto long_name = draw_comparison(press(), runs);
  Scene followed = press();
  followed.algorithm.values.at(*find_algorithm_parameter("then")) = 1.0;
  const auto title = draw_comparison(followed, runs);
  ASSERT_TRUE(short_name.ok() && long_name.ok() && title.ok());
  EXPECT_EQ(short_name->rgba, long_name->rgba);
  EXPECT_NE(short_name->rgba, title->rgba);
}

TEST(ComparisonFigure, APageWithoutRunsIsDrawn) {
  const auto none = draw_comparison(press(), {});
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(half_is_white(*none));
  const std::vector<ComparedRun> empty{{Summary{}, SampleHistory(1)}};
  const auto no_samples = draw_comparison(press(), empty);
  ASSERT_TRUE(no_samples.ok());
  EXPECT_TRUE(half_is_white(*no_samples));
}

TEST(ComparisonFigure, GrowsWithItsRuns) {
  const ComparedRun one = run(press(), "force-bounding");
  const auto height = [&](std::size_t runs) {
    return draw_comparison(press(), std::vector(runs, one))->height;
  };
  EXPECT_EQ(height(1), height(4));
  EXPECT_GT(height(kMaxComparedRuns), height(4));
  const int a4 = static_cast<int>(pixels_of_mm(297.0));
  EXPECT_LT(height(12), a4);
}

TEST(ComparisonFigure, IsTheSameInVectorFiles) {
  std::vector<ComparedRun> runs;
  for (const char* name : {"energy-bounding", "none"}) runs.push_back(run(press(), name));
  test::expect_same_in_vector_files(
      [&](Ink ink) { return draw_comparison(press(), runs, Paper{}.in(ink)); });
}

}  // namespace
}  // namespace hapticwall::draw
