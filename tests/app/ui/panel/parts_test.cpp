// The parts of the window that need neither OpenGL nor ImGui.
#include <gtest/gtest.h>

#include "app/draw/plot/plot.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/page/plots_panel.h"
#include "app/ui/panel/loop_panel.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/widgets.h"
#include "tests/temporary_folder.h"

namespace hapticwall::ui {
namespace {

TEST(RoundRange, CoversTheDataAndIsRound) {
  const draw::Extremes range = draw::round_range({0.0, 9.7}, 1.0);
  EXPECT_LE(range.minimum, 0.0);
  EXPECT_GE(range.maximum, 9.7);
  EXPECT_LT(range.maximum - range.minimum, 13.0);
  EXPECT_DOUBLE_EQ(range.maximum, std::round(range.maximum));
}

TEST(RoundRange, ConstantDataGetsTheSmallestSpanAroundIt) {
  const draw::Extremes range = draw::round_range({50.0, 50.0}, 1.0);
  EXPECT_LE(range.minimum, 49.5);
  EXPECT_GE(range.maximum, 50.5);
  EXPECT_LT(range.maximum - range.minimum, 2.0);
}

TEST(ParseNumber, TakesWhatPeopleTypeAndNothingElse) {
  EXPECT_EQ(parse_number("35000"), 35000.0);
  EXPECT_EQ(parse_number(" +3.5e4 "), 35000.0);
  EXPECT_EQ(parse_number("-0.25"), -0.25);
  EXPECT_EQ(parse_number("35000,5"), 35000.5);
  EXPECT_EQ(parse_number("0,125"), 0.125) << "no thousands begin with 0";
  EXPECT_EQ(parse_number("12,3456"), 12.3456);
  EXPECT_EQ(parse_number("35k"), 35000.0);
  EXPECT_EQ(parse_number("35 k"), 35000.0);
  EXPECT_EQ(parse_number("0,3k"), 300.0);
  EXPECT_EQ(parse_number("1.5M"), 1.5e6);
  for (const char* text : {"", " ", "abc", "35,000", "-1,234", "1.234,5", "1,2,3", "k", "1 k k",
                           "1 2", "3kN", "nan", "inf", "1e999", "+-1"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(NumberText, ShowsNoNoiseOfTheLastDigits) {
  EXPECT_EQ(rounded_number(0.05 * 1e3), "50");
  EXPECT_EQ(rounded_number(0.1 + 0.2), "0.3");
  EXPECT_EQ(rounded_number(35000.0), "35000");
}

TEST(UnusedRecordingPath, NeverTakesANameThatIsInUse) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(unused_recording_path(folder.path(), "a"), folder.file("a.csv"));
  folder.put("a.csv", "x");
  EXPECT_EQ(unused_recording_path(folder.path(), "a.csv"), folder.file("a-2.csv"));
  folder.put("a-2.toml", "x");
  folder.put("a-3.csv.partial", "x");
  EXPECT_EQ(unused_recording_path(folder.path(), "a"), folder.file("a-4.csv"));
}

TEST(CostText, TellsMedianAndMaximumInMicroseconds) {
  session::TimingStatistics timing;
  EXPECT_EQ(cost_text(timing), "–");
  timing.cost_ticks = 1000;
  timing.median_cost_s = 1.25e-6;
  timing.maximum_cost_s = 83.4e-6;
  EXPECT_EQ(cost_text(timing), "  1.2 µs, max   83 µs");
}

TEST(EnergyError, IsTheWorkOfTheHandThatNoPartHas) {
  PlantTruth truth;
  truth.hand_work_j = 10.0;
  truth.kinetic_j = 1.0;
  truth.dissipation_j = 2.0;
  truth.actuator_work_j = 4.0;
  EXPECT_EQ(energy_error_j(truth), 3.0);
}

TEST(ChangedValues, ListsValuesUnlikeTheSceneAndRestoresThem) {
  const Scene loaded = file::load_scene("press")->scene;
  Scene running = loaded;
  EXPECT_TRUE(changed_values(running, loaded).empty());
  running.x().device.friction_n.reset();
  running.x().hand->stiffness_n_per_m = 300.0;
  running.x().walls[0].stiffness_n_per_m = 1000.0;
  running.simulator = {Integrator::kRungeKutta4, 4};
  // Values that need a new session, and the choice of the algorithm, do not count.
  running.algorithm.index = 0;
  running.sampling.rate_hz = 2000.0;
  running.x().device.start_m = 0.02;
  running.x().hand->path = {{0.0, 0.02}};
  const std::vector<std::string> changed = changed_values(running, loaded);
  EXPECT_EQ(changed, (std::vector<std::string>{"device friction: none, in the scene 0.14 N",
                                               "hand stiffness: 300 N/m, in the scene 250 N/m",
                                               "wall stiffness: 1 kN/m, in the scene 35 kN/m",
                                               "simulator: rk4 × 4, in the scene exact × 1"}));
  const Scene back = with_loaded_values(running, loaded);
  EXPECT_TRUE(changed_values(back, loaded).empty());
  EXPECT_EQ(back.x().device.friction_n, 0.14);
  EXPECT_EQ(back.x().hand->path, running.x().hand->path);
  EXPECT_EQ(back.x().device.start_m, 0.02);
  EXPECT_EQ(back.algorithm.index, 0U);
  EXPECT_EQ(back.sampling.rate_hz, 2000.0);
}

}  // namespace
}  // namespace hapticwall::ui
