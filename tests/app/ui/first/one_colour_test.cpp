// Verdict, edge of the wall and lamp have one colour at every moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/ui/panel/energy_lamp_view.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/panel/wall_view.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::Tone;

constexpr int kMoments = 20;

class OneColourTest : public GuiTest {
 protected:
  [[nodiscard]] std::optional<Tone> edge() {
    const session::Snapshot snapshot = fake_->snapshot();
    const draw::Theme theme;
    return ui::shown_picture(ui::context_of(state(), *fake_, snapshot, theme, {.live = fake_}))
        .verdict;
  }
  [[nodiscard]] const draw::Tail& tail() const { return state().tails.front(); }
  [[nodiscard]] Tone lamp() const {
    return ui::lamp_tone(state().compare.transient.lamp->story(), tail());
  }

  void expect_one_colour() {
    const Tone verdict = draw::tail_tone(tail());
    EXPECT_EQ(draw::verdict_words(tail()).tone, verdict);
    EXPECT_EQ(edge(), draw::edge_tone(tail()));
    if (edge()) EXPECT_EQ(*edge(), verdict);
    EXPECT_EQ(edge().has_value(), tail().summary.verdict != Verdict::kNoContact);
    const bool alarms = verdict == Tone::kWarning || verdict == Tone::kBad;
    // The lamp speaks where energy was extracted, and then as the verdict does.
    EXPECT_TRUE(lamp() == Tone::kMuted || (alarms && lamp() == verdict));
    const bool extracted = state().compare.transient.lamp->story().state == EnergyState::kActive;
    if (alarms && extracted) EXPECT_EQ(lamp(), verdict);
  }
};

TEST_F(OneColourTest, At20MomentsOfEveryBuiltInScene) {
  int alarms = 0;
  int calm = 0;
  for (const file::BuiltinScene& builtin : file::builtin_scenes()) {
    for (const char* algorithm : {"none", "energy-bounding"}) {
      SCOPED_TRACE(std::string(builtin.name) + " under " + algorithm);
      open(std::string(builtin.name));
      AlgorithmSettings settings = scene().algorithm;
      settings.index = *find_algorithm(algorithm);
      if (fake_->set_algorithm(settings)) continue;  // it needs a wall
      const int ticks = static_cast<int>(scene().tick_count()) / kMoments;
      for (int moment = 0; moment < kMoments; ++moment) {
        fake_->advance(std::min(ticks, 500));
        frames(1);
        expect_one_colour();
        (draw::tail_tone(tail()) == Tone::kBad ? alarms : calm) += 1;
      }
    }
  }
  EXPECT_GT(alarms, kMoments);
  EXPECT_GT(calm, kMoments);
}

TEST_F(OneColourTest, FreeMotionRaisesNoAlarm) {
  live(500);  // the hand has not reached the wall
  EXPECT_EQ(draw::tail_tone(tail()), Tone::kText) << "neither good nor bad";
  EXPECT_EQ(edge(), std::nullopt);
  EXPECT_EQ(lamp(), Tone::kMuted);
  EXPECT_THAT(text(), ::testing::Not(::testing::HasSubstr("extracted")));
}

TEST_F(OneColourTest, AnExperimentOfIdentifyRaisesNoAlarm) {
  press(ImGuiKey_1);
  live(3000);
  EXPECT_EQ(draw::tail_tone(tail()), Tone::kBad);
  EXPECT_THAT(text(), ::testing::HasSubstr("oscillating"));
  state().identify.experiment =
      std::make_shared<session::IdentifyExperiment>(identify::ExperimentSettings{});
  EXPECT_EQ(edge(), std::nullopt);
  const std::string shown = text();
  EXPECT_THAT(shown, ::testing::Not(::testing::HasSubstr("oscillating")));
  EXPECT_THAT(shown, ::testing::Not(::testing::HasSubstr("extracted")));
  state().identify.experiment = nullptr;
}

}  // namespace
}  // namespace hapticwall::test
