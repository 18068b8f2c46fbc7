// The paper's own story, on the built-in scenes: what the lamp says under which algorithm.
#include "core/study/energy_story.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "app/file/scene/scene_file.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

// Reports of the lamp in the course of a run, and extremes of the rows themselves.
struct Told {
  EnergyStory last;
  std::map<EnergyState, int> ticks;
  double most_extracted_j = 0.0;
  double most_hold_beyond_budget_j = 0.0;
  double least_cv_j = 0.0;
  double least_hold_above_budget_j = 0.0;
  Summary summary;

  [[nodiscard]] int active_ticks() const {
    const auto found = ticks.find(EnergyState::kActive);
    return found == ticks.end() ? 0 : found->second;
  }
};

Told tell(const std::string& name, const std::string& algorithm) {
  const auto loaded = file::load_scene(name, std::vector{"algorithm.name=" + algorithm});
  if (!loaded) throw std::runtime_error(loaded.error().message);
  const Scene& scene = loaded->scene;
  EnergyLamp lamp(scene.sampling.rate_hz, scene.x().device.encoder_m.value_or(0.0));
  Told told;
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) {
    lamp.add(sample);
    told.last = lamp.story();
    ++told.ticks[told.last.state];
    told.most_extracted_j = std::max(told.most_extracted_j, told.last.extracted_j);
    told.most_hold_beyond_budget_j =
        std::max(told.most_hold_beyond_budget_j, told.last.hold_beyond_budget_j);
    told.least_cv_j = std::min(told.least_cv_j, sample.energy_cv_j);
    told.least_hold_above_budget_j =
        std::min(told.least_hold_above_budget_j, sample.energy_hold_j - sample.energy_budget_j);
  };
  told.summary = simulate(scene, options).summary;
  return told;
}

// Figure 4: the wall chatters, the observer is blind to it, and the hold is to blame for all of it.
TEST(PaperStory, WithoutAnAlgorithmTheObserverStaysPositiveAndTheHoldIsToBlame) {
  const Told told = tell("press", "none");
  EXPECT_EQ(told.summary.verdict, Verdict::kOscillating);
  EXPECT_EQ(told.least_cv_j, 0.0);
  EXPECT_EQ(told.last.state, EnergyState::kActive);
  EXPECT_EQ(told.last.blame, EnergyBlame::kHold);
  EXPECT_EQ(told.last.control_law_j, 0.0);
  EXPECT_NEAR(told.last.extracted_j, 0.626, 0.02);
  EXPECT_NEAR(told.last.hold_beyond_budget_j, 1.78, 0.05);
  // Hardly a tick of the chatter is anything else.
  EXPECT_GT(told.active_ticks(), 5000);
}

TEST(PaperStory, PassivityControlWithThatObserverTellsTheSame) {
  const Told none = tell("press", "none");
  const Told controlled = tell("press", "passivity-control");
  EXPECT_EQ(controlled.last.blame, EnergyBlame::kHold);
  EXPECT_EQ(controlled.last.extracted_j, none.last.extracted_j);
}

// The gap: the hold keeps its bound in every row, the hand takes three joules, and the control law
// gives them.
TEST(PaperStory, InTapEnergyBoundingKeepsTheHoldAndTheControlLawIsToBlame) {
  const Told told = tell("tap", "energy-bounding");
  EXPECT_EQ(told.summary.verdict, Verdict::kOscillating);
  EXPECT_GE(told.least_hold_above_budget_j, -1e-12);
  EXPECT_LT(told.most_hold_beyond_budget_j, 1e-12);
  EXPECT_EQ(told.last.state, EnergyState::kActive);
  EXPECT_EQ(told.last.blame, EnergyBlame::kControlLaw);
  EXPECT_NEAR(told.last.extracted_j, 3.03, 0.1);
  EXPECT_NEAR(told.last.control_law_j, 3.31, 0.1);
  // The simulator knows what the hand really took: 2.88 J, less what friction ate.
  EXPECT_NEAR(told.last.extracted_j, -*told.summary.passivity_margin_j, 0.2);
}

// Figure 6: quiet. The computer gives out more than it takes, and the damping of the device eats
// it.
TEST(PaperStory, InPressEnergyBoundingIsNeverActive) {
  const Told told = tell("press", "energy-bounding");
  EXPECT_EQ(told.summary.verdict, Verdict::kSettled);
  EXPECT_EQ(told.active_ticks(), 0);
  EXPECT_LT(told.most_hold_beyond_budget_j, 1e-12);
  EXPECT_EQ(told.last.state, EnergyState::kSpendingBudget);
  EXPECT_LT(told.last.given_out_j, told.last.budget_j);
}

// Figure 5: what the virtual coupling displays is soft, and passive throughout.
TEST(PaperStory, TheVirtualCouplingIsNeverActive) {
  for (const char* scene : {"press", "tap", "tap-slow", "light"}) {
    SCOPED_TRACE(scene);
    EXPECT_EQ(tell(scene, "virtual-coupling").active_ticks(), 0);
  }
}

TEST(PaperStory, ALightHandGetsItFromTheControlLawToo) {
  const Told told = tell("light", "energy-bounding");
  EXPECT_EQ(told.last.state, EnergyState::kActive);
  EXPECT_EQ(told.last.blame, EnergyBlame::kControlLaw);
  EXPECT_LT(told.most_hold_beyond_budget_j, 1e-12);
}

}  // namespace
}  // namespace hapticwall
