#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "app/runtime/triple_buffer.h"

namespace hapticwall::runtime {
namespace {

// Large enough that a copy is no single instruction: a torn one has unequal words.
struct Wide {
  std::array<std::uint64_t, 64> words{};
};

Wide filled_with(std::uint64_t number) {
  Wide wide;
  wide.words.fill(number);
  return wide;
}

TEST(TripleBuffer, StartsWithTheInitialValueWhichIsNotNews) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.current(), 7);
}

TEST(TripleBuffer, NewestWinsAndIsNewsOnce) {
  TripleBuffer<int> buffer;
  for (int value = 1; value <= 5; ++value) buffer.publish(value);
  EXPECT_TRUE(buffer.update());
  EXPECT_EQ(buffer.current(), 5);
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.current(), 5);
}

TEST(TripleBuffer, WhatTheConsumerLooksAtStaysWhileTheProducerGoesOn) {
  TripleBuffer<int> buffer;
  buffer.publish(1);
  ASSERT_TRUE(buffer.update());
  const int& looked_at = buffer.current();
  for (int value = 2; value <= 10; ++value) {
    buffer.publish(value);
    ASSERT_EQ(looked_at, 1);
  }
}

TEST(TripleBufferStress, ValuesAreWholeNeverGoBackAndTheLastOneArrives) {
  constexpr std::uint64_t kValues = 300'000;
  TripleBuffer<Wide> buffer;
  std::thread producer([&] {
    for (std::uint64_t number = 1; number <= kValues; ++number) {
      buffer.publish(filled_with(number));
      // On a machine of one core the consumer would else see the last value only.
      if (number % 64 == 0) std::this_thread::yield();
    }
  });
  std::uint64_t newest = 0;
  std::uint64_t seen = 0;
  std::uint64_t torn = 0;
  std::uint64_t backwards = 0;
  while (newest < kValues) {
    if (!buffer.update()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& value = buffer.current();
    for (const std::uint64_t word : value.words) torn += word == value.words[0] ? 0U : 1U;
    backwards += value.words[0] > newest ? 0U : 1U;
    newest = value.words[0];
    ++seen;
  }
  producer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(backwards, 0U);
  EXPECT_GT(seen, 1U);
}

}  // namespace
}  // namespace hapticwall::runtime
