#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "core/tick/triple_buffer.h"

namespace hapticwall {
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

TEST(TripleBuffer, TheConsumersValueStaysWhileTheProducerGoesOn) {
  TripleBuffer<int> buffer;
  buffer.publish(1);
  ASSERT_TRUE(buffer.update());
  const int& looked_at = buffer.current();
  for (int value = 2; value <= 10; ++value) {
    buffer.publish(value);
    ASSERT_EQ(looked_at, 1);
  }
}

TEST(TripleBuffer, AValueThatWasNotSeenCanBeTakenBack) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.withdraw()) << "there was nothing to take back";
  buffer.publish(1);
  ASSERT_TRUE(buffer.update());
  EXPECT_FALSE(buffer.withdraw()) << "it was seen";
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.current(), 1);
  buffer.publish(2);
  EXPECT_TRUE(buffer.withdraw());
  EXPECT_FALSE(buffer.withdraw());
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.current(), 1);
  buffer.publish(3);
  EXPECT_TRUE(buffer.update());
  EXPECT_EQ(buffer.current(), 3);
}

// Either the producer has a value back or the consumer gets it, never both and never neither; and
// no old value comes back in its place.
TEST(TripleBufferStress, AValueIsSeenOrTakenBackAndNeverBoth) {
  constexpr std::uint64_t kValues = 4'000'000;
  constexpr std::uint64_t kYieldEvery = 1U << 16U;
  TripleBuffer<std::uint64_t> buffer;
  std::vector<bool> taken_back(kValues + 1);
  std::atomic<bool> done{false};
  std::thread producer([&] {
    for (std::uint64_t number = 1; number <= kValues; ++number) {
      buffer.publish(number);
      if (number % kYieldEvery == 0) std::this_thread::yield();  // for a machine of one core
      taken_back[number] = buffer.withdraw();
    }
    done.store(true, std::memory_order_release);
  });
  std::vector<bool> seen(kValues + 1);
  std::uint64_t newest = 0;
  std::uint64_t backwards = 0;
  const auto look = [&] {
    if (!buffer.update()) return;
    backwards += buffer.current() > newest ? 0U : 1U;
    newest = buffer.current();
    seen.at(newest) = true;
  };
  while (!done.load(std::memory_order_acquire)) look();
  look();
  producer.join();
  EXPECT_EQ(backwards, 0U);
  std::uint64_t wrong = 0;
  for (std::uint64_t number = 1; number <= kValues; ++number) {
    wrong += seen[number] != taken_back[number] ? 0U : 1U;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(std::count(seen.begin(), seen.end(), true), 0);
  EXPECT_GT(std::count(taken_back.begin(), taken_back.end(), true), 0);
}

TEST(TripleBufferStress, ValuesAreWholeNeverGoBackAndTheLastOneArrives) {
  constexpr std::uint64_t kValues = 300'000;
  TripleBuffer<Wide> buffer;
  std::thread producer([&] {
    for (std::uint64_t number = 1; number <= kValues; ++number) {
      buffer.publish(filled_with(number));
      // On a machine of one core the consumer would otherwise see the last value only.
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
}  // namespace hapticwall
