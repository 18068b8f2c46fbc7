#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <thread>

#include "app/session/loop/spsc_queue.h"
#include "core/sample.h"

namespace hapticwall::session {
namespace {

TEST(SpscQueue, HoldsExactlyWhatWasAskedForAndKeepsTheOrder) {
  for (const std::size_t capacity : {1U, 2U, 3U, 64U, 1000U}) {
    SpscQueue<std::size_t> queue(capacity);
    ASSERT_EQ(queue.capacity(), capacity);
    ASSERT_EQ(queue.size(), 0U);
    for (std::size_t round = 0; round < 3; ++round) {
      for (std::size_t i = 0; i < capacity; ++i) ASSERT_TRUE(queue.try_push(i));
      ASSERT_FALSE(queue.try_push(capacity));
      ASSERT_EQ(queue.size(), capacity);
      std::size_t value = 0;
      for (std::size_t i = 0; i < capacity; ++i) {
        ASSERT_TRUE(queue.try_pop(value));
        ASSERT_EQ(value, i);
      }
      ASSERT_FALSE(queue.try_pop(value));
    }
  }
}

// A small queue: the producer counts the dropped elements; all others arrive intact and in order.
TEST(SpscQueueStress, ArrivedAndDroppedAreAllThatWasSent) {
  constexpr std::uint64_t kTicks = 400'000;
  SpscQueue<Tick> queue(512);
  std::uint64_t dropped = 0;
  std::thread producer([&] {
    for (std::uint64_t tick = 1; tick <= kTicks; ++tick) {
      Tick sent;
      sent.axes.front().tick = tick;
      sent.axes.back().truth.kinetic_j = static_cast<double>(tick);
      const bool last = tick == kTicks;
      while (!queue.try_push(sent)) {
        std::this_thread::yield();
        if (!last) {
          ++dropped;
          break;
        }
      }
    }
  });
  std::uint64_t arrived = 0;
  std::uint64_t wrong = 0;
  std::uint64_t previous = 0;
  Tick got;
  while (previous < kTicks) {
    if (!queue.try_pop(got)) {
      std::this_thread::yield();
      continue;
    }
    ++arrived;
    const std::uint64_t tick = got.x().tick;
    const bool in_order = tick > previous;
    const bool whole = got.axes.back().truth.kinetic_j == static_cast<double>(tick);
    wrong += in_order && whole ? 0U : 1U;
    previous = tick;
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(arrived + dropped, kTicks);
}

}  // namespace
}  // namespace hapticwall::session
