#include "app/sound/live/sound_player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "tests/app/session/support.h"
#include "tests/app/sound/live/busy_card.h"

namespace hapticwall::sound::test {
namespace {

using session::test::eventually;
using ::testing::HasSubstr;

std::shared_ptr<session::SoundFeed> new_feed() { return std::make_shared<session::SoundFeed>(64); }

// Pushes a tick of a handle that moves to and fro at 50 Hz.
bool push(session::SoundFeed& feed, std::uint64_t tick) {
  Tick pushed;
  pushed.axes[0].tick = tick;
  pushed.axes[0].truth.velocity_m_per_s = tick % 20 < 10 ? 0.1 : -0.1;
  return feed.ticks.try_push(pushed);
}

class SilentCard final : public Card {
 public:
  [[nodiscard]] CardFacts facts() const override { return {"silent", 48000.0, 128, 0.005}; }
};

TEST(SoundPlayer, PlaysTheSessionThatItFollows) {
  const auto heard = std::make_shared<Heard>();
  SoundPlayer player(busy_card(heard));
  const auto first = new_feed();
  const auto second = new_feed();
  player.follow({first, 1000.0, true});
  EXPECT_FALSE(first->wanted);
  EXPECT_EQ(player.status().state, SoundState::kOff);
  player.play(true);
  EXPECT_TRUE(eventually([&] { return first->wanted.load(); }));
  std::uint64_t tick = 0;
  EXPECT_TRUE(eventually([&] {
    if (first->ticks.size() < 10 && push(*first, tick)) ++tick;
    return heard->samples > 100;
  }));
  EXPECT_EQ(player.status().state, SoundState::kPlaying);
  EXPECT_THAT(describe(player.status()), HasSubstr("busy: the sound is "));
  player.follow({second, 1000.0, true});
  EXPECT_FALSE(first->wanted);
  EXPECT_TRUE(eventually([&] { return second->wanted.load(); }));
  player.play(false);
  EXPECT_TRUE(eventually([&] { return !second->wanted; }));
  EXPECT_TRUE(eventually([&] { return player.status().state == SoundState::kOff; }));
}

TEST(SoundPlayer, NoCardIsOneSentence) {
  const auto attempts = std::make_shared<std::atomic<int>>(0);
  SoundPlayer player([attempts](const FillSound&) -> Result<std::unique_ptr<Card>> {
    ++*attempts;
    return Error{ErrorKind::kDevice, "no sound card"};
  });
  const auto feed = new_feed();
  player.follow({feed, 1000.0, true});
  for (int attempt = 1; attempt <= 2; ++attempt) {
    player.play(true);
    EXPECT_TRUE(eventually([&] { return player.status().state == SoundState::kNoCard; }));
    EXPECT_EQ(describe(player.status()), "There is no sound: no sound card.");
    EXPECT_FALSE(feed->wanted);
    EXPECT_EQ(*attempts, attempt);
    player.play(false);
    EXPECT_TRUE(eventually([&] { return player.status().state == SoundState::kOff; }));
  }
}

// The loop's queue is emptied all the same.
TEST(SoundPlayer, ACardThatNeverCallsIsTold) {
  SoundPlayer player([](const FillSound&) -> Result<std::unique_ptr<Card>> {
    return std::unique_ptr<Card>(std::make_unique<SilentCard>());
  });
  const auto feed = new_feed();
  player.follow({feed, 1000.0, true});
  player.play(true);
  EXPECT_TRUE(eventually([&] { return feed->wanted.load(); }));
  for (std::uint64_t tick = 0; tick < 40; ++tick) EXPECT_TRUE(push(*feed, tick));
  EXPECT_TRUE(eventually([&] { return feed->ticks.size() == 0; }));
  EXPECT_TRUE(eventually([&] { return player.status().state == SoundState::kStuck; }));
  EXPECT_THAT(describe(player.status()), HasSubstr("switch the sound off and on again"));
}

// Neither the window nor the loop waits for it, and the program ends.
TEST(SoundPlayer, ACardThatBlocksHoldsNobodyUp) {
  std::promise<void> release;
  const std::shared_future<void> released = release.get_future().share();
  const auto ended = std::make_shared<std::promise<void>>();
  const auto feed = new_feed();
  {
    SoundPlayer player([released, ended](const FillSound&) -> Result<std::unique_ptr<Card>> {
      released.wait();
      ended->set_value();
      return Error{ErrorKind::kDevice, "late"};
    });
    player.follow({feed, 1000.0, true});
    player.play(true);
    EXPECT_TRUE(eventually([&] { return player.status().state == SoundState::kOpening; }));
    player.mix({1.0, true});
    player.play(false);
    player.play(true);
    EXPECT_FALSE(feed->wanted);
  }
  release.set_value();
  ended->get_future().wait();
}

}  // namespace
}  // namespace hapticwall::sound::test
