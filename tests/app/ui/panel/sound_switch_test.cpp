#include "app/ui/panel/sound_switch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "app/ui/state/blind_test.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using sound::test::Felt;
using sound::test::Heard;
using ::testing::HasSubstr;

class SoundSwitchTest : public GuiTest {
 protected:
  void open_with_card() {
    open_card = sound::test::busy_card(heard_);
    open("press");
  }
  // Ticks of a handle on its way, until the card has played `samples` more.
  void play(int samples) {
    const int enough = heard_->samples + samples;
    frames_until([&] {
      if (fake_->feed->ticks.size() < 10) fake_->advance(4);
      return heard_->samples > enough;
    });
  }
  [[nodiscard]] float loudest_of(int samples) {
    play(samples);
    heard_->loudest = 0.0F;
    play(samples);
    return heard_->loudest;
  }

  void open_with_gamepad() {
    open_gamepad = sound::test::fake_gamepad(felt_);
    open("press");
  }
  // A handle that swings, until the condition holds.
  void swing_until(const std::function<bool()>& condition) {
    frames_until([&] {
      for (int i = 0; i < 4 && fake_->feed->ticks.size() < 10; ++i) {
        Tick tick;
        tick.axes[0].tick = ++swung_;
        tick.axes[0].truth.velocity_m_per_s = swung_ % 20 < 10 ? 0.1 : -0.1;
        static_cast<void>(fake_->feed->ticks.try_push(tick));
      }
      return condition();
    });
  }

  std::shared_ptr<Heard> heard_ = std::make_shared<Heard>();
  std::shared_ptr<Felt> felt_ = std::make_shared<Felt>();
  std::uint64_t swung_ = 0;
};

TEST_F(SoundSwitchTest, IsOffAtFirst) {
  open_with_card();
  EXPECT_FALSE(state().transient.sound_on);
  EXPECT_FALSE(fake_->feed->wanted);
  EXPECT_TRUE(sees("sound"));
  EXPECT_FALSE(sees("##volume"));
}

TEST_F(SoundSwitchTest, PlaysTheSessionAndTellsTheDelay) {
  open_with_card();
  click("sound");
  frames_until([&] { return fake_->feed->wanted.load(); });
  play(200);
  EXPECT_TRUE(sees("##volume"));
  frames_until([&] { return state().transient.sound.state == sound::SoundState::kPlaying; });
  EXPECT_THAT(describe(state().transient.sound), HasSubstr(" ms behind the handle"));
  click("sound");
  frames_until([&] { return !fake_->feed->wanted; });
  EXPECT_FALSE(state().transient.sound_on);
}

TEST_F(SoundSwitchTest, WithoutACardOneSentenceSaysSo) {
  click("sound");
  frames_until([&] { return !state().transient.sound_on; });
  EXPECT_EQ(message().text, "There is no sound: no sound card.");
  EXPECT_EQ(message().kind, ui::MessageKind::kNote);
  EXPECT_EQ(state().transient.toasts.list().size(), 1U);
}

TEST_F(SoundSwitchTest, FollowsTheNextSession) {
  open_with_card();
  click("sound");
  const auto first = fake_->feed;
  frames_until([&] { return first->wanted.load(); });
  state().transient.wanted_scene = ui::WantedScene{scene()};
  frames_until([&] { return fake_->feed != first && fake_->feed->wanted; });
  EXPECT_FALSE(first->wanted);
}

TEST_F(SoundSwitchTest, SlowMotionIsSilent) {
  open_with_card();
  click("sound");
  frames_until([&] { return fake_->feed->wanted.load(); });
  fake_->slow_down(10);
  frames_until([&] { return !fake_->feed->wanted; });
  fake_->slow_down(1);
  frames_until([&] { return fake_->feed->wanted.load(); });
}

// A blind test hears noise, unless the sound is its question.
TEST_F(SoundSwitchTest, ABlindTestIsMasked) {
  open_with_card();
  state().persisted.sound_volume = 1.0;
  state().transient.sound_on = true;
  EXPECT_LT(loudest_of(2000), 0.05F);
  show_page(state(), ui::kBlindTestPage);
  frames(3);
  click("blind start");
  ASSERT_TRUE(ui::blind_test_runs(state()));
  EXPECT_GT(loudest_of(2000), 0.2F);
  state().compare.persisted.masking_noise = false;
  EXPECT_LT(loudest_of(2000), 0.05F);
}

TEST_F(SoundSwitchTest, RumbleIsOffAtFirstAndNeedsNoCard) {
  open_with_gamepad();
  EXPECT_FALSE(state().transient.rumble_on);
  EXPECT_EQ(felt_->open, 0);
  click("rumble");
  swing_until([&] { return felt_->rumbles(); });
  EXPECT_TRUE(sees("##volume"));
  EXPECT_FALSE(state().transient.sound_on);
  click("rumble");
  swing_until([&] { return felt_->open == 0; });
  EXPECT_FALSE(felt_->rumbles());
  EXPECT_FALSE(fake_->feed->wanted);
}

TEST_F(SoundSwitchTest, WithoutAGamepadOneSentenceSaysSo) {
  click("rumble");
  frames_until([&] { return !state().transient.rumble_on; });
  EXPECT_EQ(message().text, "There is no rumble: no gamepad.");
  EXPECT_EQ(message().kind, ui::MessageKind::kNote);
  EXPECT_EQ(state().transient.toasts.list().size(), 1U);
}

TEST_F(SoundSwitchTest, AnUnpluggedGamepadIsToldAndTheSwitchGoesBack) {
  open_with_gamepad();
  click("rumble");
  swing_until([&] { return felt_->rumbles(); });
  felt_->plugged_in = false;
  swing_until([&] { return !state().transient.rumble_on; });
  EXPECT_EQ(message().text, "There is no rumble: fake pad: No such device.");
  felt_->plugged_in = true;
  click("rumble");
  swing_until([&] { return felt_->rumbles(); });
}

// The rumble would tell the wall.
TEST_F(SoundSwitchTest, ABlindTestDoesNotRumbleAndSaysWhy) {
  open_with_gamepad();
  click("rumble");
  swing_until([&] { return felt_->rumbles(); });
  click("page Blind test");
  frames(3);
  click("blind start");
  ASSERT_TRUE(ui::blind_test_runs(state()));
  swing_until([&] { return !felt_->rumbles(); });
  const std::size_t calls = felt_->calls().size();
  const std::uint64_t until = swung_ + 500;
  swing_until([&] { return swung_ > until; });
  EXPECT_EQ(felt_->calls().size(), calls);
  move_to(rect("rumble").centre());
  frames(60);  // tooltips take their time
  EXPECT_THAT(text(), HasSubstr("the rumble would tell the wall"));
  click("rumble");
  EXPECT_TRUE(state().transient.rumble_on) << "it cannot be used now";
  state().compare.persisted.masking_noise = false;
  swing_until([&] { return felt_->rumbles(); });
}

}  // namespace
}  // namespace hapticwall::test
