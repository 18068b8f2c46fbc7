#include "app/ui/panel/sound_switch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "app/ui/state/blind_test.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

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

  std::shared_ptr<Heard> heard_ = std::make_shared<Heard>();
};

TEST_F(SoundSwitchTest, IsOffAtFirst) {
  open_with_card();
  EXPECT_FALSE(state().sound.on);
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
  frames_until([&] { return state().sound.status.state == sound::SoundState::kPlaying; });
  EXPECT_THAT(describe(state().sound.status), HasSubstr(" ms behind the handle"));
  click("sound");
  frames_until([&] { return !fake_->feed->wanted; });
  EXPECT_FALSE(state().sound.on);
}

TEST_F(SoundSwitchTest, WithoutACardOneSentenceSaysSo) {
  click("sound");
  frames_until([&] { return !state().sound.on; });
  EXPECT_EQ(message().text, "There is no sound: no sound card.");
  EXPECT_EQ(message().kind, ui::MessageKind::kNote);
  EXPECT_EQ(state().toasts.list().size(), 1U);
}

TEST_F(SoundSwitchTest, FollowsTheNextSession) {
  open_with_card();
  click("sound");
  const auto first = fake_->feed;
  frames_until([&] { return first->wanted.load(); });
  state().scene.wanted = ui::WantedScene{scene()};
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
  state().sound.volume = 1.0;
  state().sound.on = true;
  EXPECT_LT(loudest_of(2000), 0.05F);
  start_trials(4);
  EXPECT_GT(loudest_of(2000), 0.2F);
  state().compare.persisted.masking_noise = false;
  EXPECT_LT(loudest_of(2000), 0.05F);
}

}  // namespace
}  // namespace hapticwall::test
