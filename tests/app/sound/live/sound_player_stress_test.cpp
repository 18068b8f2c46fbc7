// Loop, owner, sound and card on a thread each, for ThreadSanitizer.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "app/sound/live/sound_player.h"
#include "tests/app/sound/live/busy_card.h"

namespace hapticwall::sound::test {
namespace {

TEST(SoundPlayerStress, SwitchesAndSessionsWhileTheLoopRuns) {
  constexpr int kRounds = 30;
  const auto heard = std::make_shared<Heard>();
  const std::array feeds{std::make_shared<session::SoundFeed>(64),
                         std::make_shared<session::SoundFeed>(64)};
  std::atomic<bool> end{false};
  std::thread loop([&] {
    Tick tick;
    while (!end) {
      ++tick.axes[0].tick;
      tick.axes[0].truth.velocity_m_per_s = -tick.axes[0].truth.velocity_m_per_s + 0.1;
      for (const auto& feed : feeds) {
        if (feed->wanted) static_cast<void>(feed->ticks.try_push(tick));
      }
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  });
  {
    SoundPlayer player(busy_card(heard));
    for (int round = 0; round < kRounds; ++round) {
      player.follow({feeds.at(static_cast<std::size_t>(round) % feeds.size()), 1000.0, true});
      player.mix({0.5, round % 3 == 0});
      player.play(round % 5 != 4);
      static_cast<void>(player.status());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  end = true;
  loop.join();
  for (const auto& feed : feeds) EXPECT_FALSE(feed->wanted);
}

}  // namespace
}  // namespace hapticwall::sound::test
