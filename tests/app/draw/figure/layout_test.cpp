// Every figure at the widths of a journal: its text is large enough, nothing covers it, and the
// page's edge cuts nothing off.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "app/draw/figure/comparison_figure.h"
#include "app/draw/figure/figure.h"
#include "app/draw/figure/identify_figure.h"
#include "app/draw/figure/log_figure.h"
#include "app/draw/figure/map_figure.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/draw/figure/page_texts.h"
#include "tests/core/study/identify/trial_device.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using DrawOn = std::function<Result<file::Picture>(const Paper& paper)>;

void expect_readable_at_every_width(const DrawOn& draw) {
  for (const double width_mm : {kMinWidthMm, kSingleWidthMm, 119.0, kDoubleWidthMm, kMaxWidthMm}) {
    SCOPED_TRACE(width_mm);
    const Result<file::Picture> figure = draw({width_mm, Ink::kShapes});
    ASSERT_TRUE(figure.ok()) << figure.error().message;
    EXPECT_NEAR(figure->width, pixels_of_mm(width_mm), 0.51);
    test::expect_readable(*figure);
  }
}

Scene scene_of(const char* name, const char* algorithm) {
  Scene scene = file::load_scene(name)->scene;
  scene.algorithm.index = *find_algorithm(algorithm);
  return scene;
}

TEST(Layout, TheSizesOfTextHoldOnPaper) {
  const Scene scene = scene_of("press", "none");
  const auto samples = testing::samples_of(scene);
  for (const double width_mm : {kSingleWidthMm, kDoubleWidthMm}) {
    const auto figure = draw_figure(scene, samples, {width_mm, Ink::kShapes});
    ASSERT_TRUE(figure.ok());
    const auto points = [&](const char* text) {
      return points_of_pixels(test::find_text(*figure, text).em);
    };
    EXPECT_NEAR(points("position x (mm)"), 8.1, 0.1);
    EXPECT_NEAR(points("time t (s)"), 8.1, 0.1);
    EXPECT_NEAR(points("40"), 7.0, 0.1) << "a tick";
    EXPECT_NEAR(points("max"), 6.5, 0.1) << "a subscript";
    EXPECT_GT(points("press"), 9.0);
  }
}

TEST(Layout, OfARun) {
  for (const char* name : {"press", "tap"}) {
    for (const char* algorithm : {"none", "energy-bounding"}) {
      SCOPED_TRACE(std::string(name) + " under " + algorithm);
      const Scene scene = scene_of(name, algorithm);
      const auto samples = testing::samples_of(scene);
      expect_readable_at_every_width(
          [&](const Paper& paper) { return draw_figure(scene, samples, paper); });
    }
  }
}

TEST(Layout, OfARunWithSignalsAndAPlane) {
  const Scene scene = scene_of("tap", "energy-bounding");
  SignalNames signals{};
  signals[0] = "step_bound_n";
  signals[1] = "some_long_name_of_a_speed_m_per_s";
  const auto samples = testing::samples_of(scene);
  expect_readable_at_every_width(
      [&](const Paper& paper) { return draw_figure(scene, samples, paper, signals, 1); });
  SampleHistory history(samples.size(), scene.x().device.encoder_m);
  history.push(samples);
  FigureView view;
  view.window = {0.0, 1.0};
  view.plots = kAllPlots;
  view.phase.shown = true;
  expect_readable_at_every_width(
      [&](const Paper& paper) { return draw_figure(scene, history, view, paper); });
}

std::vector<ComparedRun> runs_of(const Scene& scene, std::size_t count) {
  std::vector<ComparedRun> runs;
  for (std::size_t i = 0; i < count; ++i) {
    Scene each = scene;
    each.algorithm.index = i % algorithms().size();
    SampleHistory history(each.tick_count(), each.x().device.encoder_m);
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) { history.push(sample); };
    Summary summary = simulate(each, options).summary;
    runs.push_back({std::move(summary), std::move(history)});
  }
  return runs;
}

TEST(Layout, OfAComparison) {
  for (const char* name : {"press", "tap"}) {
    const Scene scene = file::load_scene(name)->scene;
    for (const std::size_t count : {1U, 2U, 3U, 8U, 10U, 16U}) {
      SCOPED_TRACE(std::string(name) + ", " + std::to_string(count));
      const std::vector<ComparedRun> runs = runs_of(scene, count);
      expect_readable_at_every_width(
          [&](const Paper& paper) { return draw_comparison(scene, runs, paper); });
    }
  }
}

TEST(Layout, OfAComparisonWithTheLongNamesOfPlugins) {
  const Scene scene = file::load_scene("press")->scene;
  std::vector<ComparedRun> runs = runs_of(scene, 4);
  for (ComparedRun& run : runs)
    run.summary.algorithm = "my-own-law-with-a-name-that-is-long-wi\u00fcrklich (held-force)";
  expect_readable_at_every_width(
      [&](const Paper& paper) { return draw_comparison(scene, runs, paper); });
}

// All verdicts, in the cells of a map with as many algorithms.
struct DrawnMap {
  StabilityMap map;
  std::vector<MapMetrics> cells;

  DrawnMap(const char* x, const char* y, bool logarithmic, std::size_t algorithm_count) {
    map.scene = file::load_scene("press")->scene;
    for (std::size_t i = 0; i < algorithm_count; ++i) map.algorithms.push_back(i);
    map.x = {find_scene_number(map.scene, x).value(), 1e-3, 1e2, 12, logarithmic};
    map.y = {find_scene_number(map.scene, y).value(), 0.02, 0.05, 10, logarithmic};
    for (std::size_t i = 0; i < map.cell_count(); ++i) {
      MapMetrics cell;
      cell.verdict = static_cast<Verdict>(i % kVerdictNames.size());
      cell.tail_peak_to_peak_m = 1e-4 * static_cast<double>(1 + i % 500);
      cells.push_back(cell);
    }
  }
};

TEST(Layout, OfAMap) {
  for (const std::size_t count : {1U, 2U, 3U, 5U, 8U}) {
    for (const bool logarithmic : {false, true}) {
      for (const auto& [x, y] :
           {std::pair{"wall.stiffness_n_per_m", "device.damping_n_s_per_m"},
            std::pair{"device.friction_n", "wall.position_m"},
            std::pair{"algorithm.max_damping_n_s_per_m", "device.amplifier_time_constant_s"}}) {
        SCOPED_TRACE(std::string(x) + (logarithmic ? ", log, " : ", ") + std::to_string(count));
        const DrawnMap drawn(x, y, logarithmic, count);
        expect_readable_at_every_width(
            [&](const Paper& paper) { return draw_map(drawn.map, drawn.cells, paper); });
      }
    }
  }
}

TEST(Layout, AMapHasNamesInThePlaceOfKeys) {
  const DrawnMap drawn("wall.stiffness_n_per_m", "device.friction_n", true, 1);
  const auto figure = draw_map(drawn.map, drawn.cells, {kSingleWidthMm, Ink::kShapes});
  ASSERT_TRUE(figure.ok());
  const std::string texts = test::all_texts(*figure);
  EXPECT_THAT(texts, HasSubstr("wall stiffness K (kN/m)"));
  EXPECT_THAT(texts, HasSubstr("device friction f\nc\n"));
  EXPECT_THAT(texts, Not(HasSubstr("_")));
}

// Many points close to each other, and names that are as long as they get.
LogFigure crowded_figure(std::size_t plots) {
  LogFigure figure{.title = "golden-hard  ·  energy-limited-spring",
                   .subject = "a search for a hand that takes energy",
                   .note = "ramps, energy after their end, wide bounds, seed 4294967295, 6 s each",
                   .hollow = "typical energy of the shown hand, among hands within 1 %",
                   .labels = "substeps a tick",
                   .missing = "diverged, not shown: semi-implicit-euler 1, rk4 1",
                   .plots = {}};
  for (std::size_t p = 0; p < plots; ++p) {
    LogPlot plot;
    plot.title = "(a) Largest error of position";
    plot.title[1] = static_cast<char>('a' + p);
    plot.quantity = "largest error |Δx|";
    plot.unit = "m";
    plot.x_title = "cost (ns per tick)";
    plot.goal = 1.0;
    for (std::size_t s = 0; s < 6; ++s) {
      LogSeries series{.name = "energy-bounding-2010 then passivity-control",
                       .tone = Tone::kForce,
                       .mark = Mark::kCircle,
                       .radius = 1.0F,
                       .labels_above = s % 2 == 0,
                       .points = {}};
      for (std::size_t i = 0; i < 10; ++i) {
        const auto place = static_cast<double>(i);
        series.points.push_back({10.0 * std::pow(1.3, place), 1e-3 * static_cast<double>(s) + 0.5,
                                 std::to_string(1000 + i), i > 0});
      }
      plot.series.push_back(std::move(series));
    }
    figure.plots.push_back(std::move(plot));
  }
  return figure;
}

TEST(Layout, OfAFigureWithLogarithmicAxes) {
  for (const std::size_t plots : {1U, 2U}) {
    const LogFigure figure = crowded_figure(plots);
    expect_readable_at_every_width(
        [&](const Paper& paper) { return draw_log_page(figure, paper); });
  }
}

TEST(Layout, OfAnIdentification) {
  const testing::TrialRun run = testing::run_trial(testing::TrialDevice{}, 6.0);
  auto found = identify::identify(run.record, run.facts);
  ASSERT_TRUE(found);
  for (const bool fits : {true, false}) {
    found->fits = fits;
    expect_readable_at_every_width(
        [&](const Paper& paper) { return draw_identification(run.record, *found, paper); });
  }
}

}  // namespace
}  // namespace hapticwall::draw
