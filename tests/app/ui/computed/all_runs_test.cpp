#include "app/ui/computed/all_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "app/draw/verdict/tail.h"
#include "app/file/scene/scene_file.h"
#include "core/run/simulate.h"
#include "tests/app/session/support.h"

namespace hapticwall::test {
namespace {

using ui::AlgorithmRun;
using ui::AllRuns;

Scene press() { return file::load_scene("press")->scene; }

TEST(RunAll, HasEveryAlgorithmWithTheSummaryOfASimulation) {
  const std::vector<AlgorithmRun> runs = ui::run_all(press());
  std::set<std::size_t> seen;
  for (const AlgorithmRun& run : runs) {
    seen.insert(run.algorithm.settings.index);
    Scene one = press();
    one.algorithm = run.algorithm.settings;
    const Summary wanted = simulate(one).summary;
    EXPECT_EQ(draw::figures_text(run.summary), draw::figures_text(wanted)) << run.algorithm.label;
    EXPECT_EQ(run.summary.tail_force_std_n, wanted.tail_force_std_n) << run.algorithm.label;
    EXPECT_EQ(run.summary.min_energy_scv_j, wanted.min_energy_scv_j) << run.algorithm.label;
  }
  EXPECT_EQ(seen.size(), algorithms().size());
}

TEST(RunAll, ATraceSpansTheExtremesOfTheLastSeconds) {
  for (const AlgorithmRun& run : ui::run_all(press())) {
    Scene one = press();
    one.algorithm = run.algorithm.settings;
    std::vector<double> places;
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) {
      if (sample.tick >= 4000) places.push_back(sample.truth.position_m);
    };
    static_cast<void>(simulate(one, options));
    ASSERT_EQ(run.position_m.time_s.size(), run.position_m.value.size());
    EXPECT_LE(run.position_m.value.size(), 2 * ui::kTraceColumns);
    EXPECT_EQ(run.position_m.time_s.front(), 4.0);
    EXPECT_EQ(std::ranges::min(run.position_m.value), std::ranges::min(places));
    EXPECT_EQ(std::ranges::max(run.position_m.value), std::ranges::max(places));
  }
}

TEST(RunAll, KeepsEveryFormWhereTheSceneNamesOne) {
  Scene scene = press();
  const std::size_t all = ui::run_all(scene).size();
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    const auto form = find_algorithm_parameter(algorithms()[i].forms_key);
    if (form) scene.algorithm.values[*form] = 0.0;
  }
  EXPECT_GT(all, algorithms().size());
  EXPECT_EQ(ui::run_all(scene).size(), all);
}

void take_until(AllRuns& all, const std::function<bool()>& condition) {
  EXPECT_TRUE(session::test::eventually([&] {
    all.take();
    return condition();
  }));
}

TEST(AllRunsTest, OfAnotherSceneReplaceThoseBefore) {
  AllRuns all;
  all.ask_for(press());
  EXPECT_TRUE(all.running());
  take_until(all, [&] { return all.up_to_date(); });
  const std::string before = draw::figures_text(all.runs().front().summary);
  Scene soft = press();
  soft.x().walls.front().stiffness_n_per_m = 500.0;
  all.ask_for(soft);
  EXPECT_FALSE(all.up_to_date());
  EXPECT_FALSE(all.runs().empty()) << "the old ones stay until then";
  take_until(all, [&] { return all.up_to_date(); });
  EXPECT_NE(draw::figures_text(all.runs().front().summary), before);
}

TEST(AllRunsTest, AnotherAlgorithmInForceChangesNothing) {
  AllRuns all;
  all.ask_for(press());
  take_until(all, [&] { return all.up_to_date(); });
  Scene other = press();
  other.algorithm.index = (other.algorithm.index + 1) % algorithms().size();
  all.ask_for(other);
  EXPECT_FALSE(all.running());
  EXPECT_TRUE(all.up_to_date());
}

TEST(AllRunsTest, AStopEndsTheRunsAndTheNextQuestionBeginsAgain) {
  Scene endless = press();
  endless.duration_s = 1e5;
  AllRuns all;
  all.ask_for(endless);
  all.stop();
  EXPECT_FALSE(all.running());
  all.ask_for(endless);
  EXPECT_TRUE(all.running());
}

}  // namespace
}  // namespace hapticwall::test
