#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <thread>

#include "app/runtime/spsc_queue.h"
#include "core/sample.h"

namespace hapticwall::runtime {
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

// A queue much smaller than what goes through it: the producer counts what it drops, and what
// arrives is whole, in order, and all the rest.
TEST(SpscQueueStress, ArrivedAndDroppedAreAllThatWasSent) {
  constexpr std::uint64_t kSamples = 400'000;
  SpscQueue<Sample> queue(512);
  std::uint64_t dropped = 0;
  std::thread producer([&] {
    for (std::uint64_t tick = 1; tick <= kSamples; ++tick) {
      Sample sample;
      sample.tick = tick;
      sample.position_m = static_cast<double>(tick);
      sample.truth.kinetic_j = static_cast<double>(tick);
      const bool last = tick == kSamples;
      while (!queue.try_push(sample)) {
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
  Sample sample;
  while (previous < kSamples) {
    if (!queue.try_pop(sample)) {
      std::this_thread::yield();
      continue;
    }
    ++arrived;
    const bool in_order = sample.tick > previous;
    const bool whole = sample.position_m == static_cast<double>(sample.tick) &&
                       sample.truth.kinetic_j == static_cast<double>(sample.tick);
    wrong += in_order && whole ? 0U : 1U;
    previous = sample.tick;
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(arrived + dropped, kSamples);
}

}  // namespace
}  // namespace hapticwall::runtime
