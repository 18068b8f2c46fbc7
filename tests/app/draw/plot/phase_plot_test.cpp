#include "app/draw/plot/phase_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall::draw {
namespace {

// An ellipse of half axes a and b around (centre, centre), once round: area π a b.
SampleHistory ellipse(double a_m, double b_n, int samples, double direction) {
  SampleHistory history(static_cast<std::size_t>(samples) + 1);
  for (int i = 0; i <= samples; ++i) {
    const double angle = direction * 2.0 * std::numbers::pi * i / std::max(samples, 1);
    Sample sample;
    sample.tick = static_cast<std::uint64_t>(i);
    sample.time_s = i * 1e-3;
    sample.penetration_m = 1e-3 + a_m * std::cos(angle);
    sample.force_n = 5.0 + b_n * std::sin(angle);
    history.push(sample);
  }
  return history;
}

double energy_of(const SampleHistory& history, bool true_position = false) {
  PhasePath path;
  trace_phase(history, {0, history.size()}, true_position, path);
  return phase_energy_j(path);
}

TEST(PhasePlot, TheAreaOfAnEllipseIsPiAB) {
  const double area_j = std::numbers::pi * 0.5e-3 * 2.0;
  // Force rises first where penetration falls: counterclockwise, energy comes out.
  EXPECT_NEAR(energy_of(ellipse(0.5e-3, 2.0, 5000, 1.0)), -area_j, 1e-6 * area_j);
  EXPECT_NEAR(energy_of(ellipse(0.5e-3, 2.0, 5000, -1.0)), area_j, 1e-6 * area_j);
}

// A spring, sampled and held: each step in meets the smaller force of the step before, each step
// out the larger one.
TEST(PhasePlot, TheHoldsLoopOfASampledSpringIsTheStaircaseBetweenInAndOut) {
  constexpr int kSteps = 10;
  constexpr double kStiffness = 1000.0;
  constexpr double kStepM = 1e-4;
  SampleHistory history(100);
  for (int i = 0; i <= 2 * kSteps; ++i) {
    Sample sample;
    sample.tick = static_cast<std::uint64_t>(i);
    const int depth = i <= kSteps ? i : 2 * kSteps - i;
    sample.penetration_m = depth * kStepM;
    sample.force_n = kStiffness * sample.penetration_m;
    history.push(sample);
  }
  // Energy in: Σ_{k=0}^{n-1} K k d², out: Σ_{k=1}^{n} K k d²; the difference is n K d².
  EXPECT_NEAR(energy_of(history), -kSteps * kStiffness * kStepM * kStepM, 1e-12);
}

TEST(PhasePlot, TheEnergyOfARunIsWhatTheLedgerHas) {
  for (const char* algorithm : {"none", "energy-bounding"}) {
    Scene scene = file::load_scene("press")->scene;
    scene.algorithm.index = *find_algorithm(algorithm);
    scene.duration_s = 4.0;
    SampleHistory history(10000);
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) { history.push(sample); };
    static_cast<void>(simulate(scene, options));
    const std::size_t last = history.size() - 1;
    const auto difference = [&](Quantity quantity) {
      return history.value(quantity, last) - history.value(quantity, 0);
    };
    EXPECT_NEAR(energy_of(history), difference(&Sample::energy_scv_j), 1e-9) << algorithm;
    EXPECT_NEAR(energy_of(history, true), difference(&PlantTruth::actuator_work_j), 1e-9)
        << algorithm;
  }
}

SampleHistory two_touches(std::size_t samples) {
  SampleHistory history(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    Sample sample;
    sample.tick = i;
    sample.time_s = static_cast<double>(i) * 1e-3;
    const bool touching = (i >= 100 && i < 200) || (i >= 400 && i < 450);
    sample.penetration_m = touching ? 1e-4 : -1e-4;
    sample.force_n = touching ? 1.0 : 0.0;
    history.push(sample);
  }
  return history;
}

TEST(PhasePlot, TheLastContactIsTheNewestThatBeginsInTheWindow) {
  const SampleHistory history = two_touches(1000);
  PhaseSettings settings;
  settings.last_contact = true;
  IndexRange range = phase_range(history, settings, {0.0, 1.0});
  EXPECT_EQ(range.first, 399U);  // the sample in front of the wall
  EXPECT_EQ(range.last, 451U);
  range = phase_range(history, settings, {0.0, 0.3});
  EXPECT_EQ(range.first, 99U);
  EXPECT_EQ(range.last, 201U);
  EXPECT_EQ(phase_range(history, settings, {0.5, 1.0}).count(), 0U);
  settings.last_contact = false;
  EXPECT_EQ(phase_range(history, settings, {0.5, 0.6}).count(), 101U);
}

TEST(PhasePlot, DrawsTheNewestSamplesOfALongWindow) {
  const SampleHistory history = two_touches(30000);
  const IndexRange range = phase_range(history, {}, {0.0, 25.0});
  EXPECT_EQ(range.count(), kMaxPhaseSamples);
  EXPECT_EQ(range.last, 25001U);
}

TEST(PhasePlot, SpansOfALineThatTouchAreOne) {
  std::vector<PixelSpan> spans{{5, 10, 20}, {4, 0, 3}, {5, 20, 25}, {5, 30, 31},
                               {5, 12, 14}, {4, 0, 3}, {5, 8, 11}};
  join_spans(spans);
  EXPECT_EQ(spans, (std::vector<PixelSpan>{{4, 0, 3}, {5, 8, 25}, {5, 30, 31}}));
}

// Against brute force: what is painted stays painted, nothing twice.
TEST(PhasePlot, JoinedSpansPaintTheSamePixelsOnce) {
  std::mt19937 random(11);
  std::vector<PixelSpan> spans;
  std::set<std::pair<int, int>> pixels;
  for (int i = 0; i < 3000; ++i) {
    const int from = static_cast<int>(random() % 300);
    const PixelSpan span{static_cast<int>(random() % 40), from,
                         from + 1 + static_cast<int>(random() % 20)};
    spans.push_back(span);
    for (int x = span.from; x < span.to; ++x) pixels.emplace(span.line, x);
  }
  join_spans(spans);
  std::size_t painted = 0;
  for (const PixelSpan& span : spans) {
    for (int x = span.from; x < span.to; ++x) ASSERT_TRUE(pixels.contains({span.line, x}));
    painted += static_cast<std::size_t>(span.to - span.from);
  }
  EXPECT_EQ(painted, pixels.size());
}

TEST(PhasePlot, NoLoopIsNoEnergy) {
  EXPECT_EQ(energy_of(SampleHistory(10)), 0.0);
  EXPECT_EQ(energy_of(ellipse(1e-3, 1.0, 0, 1.0)), 0.0);
}

}  // namespace
}  // namespace hapticwall::draw
