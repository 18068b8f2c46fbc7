#include "core/tick/pulse.h"

#include <gtest/gtest.h>

#include <vector>

namespace hapticwall {
namespace {

constexpr std::int64_t kMaxNs = 1000;

TEST(Pulse, IsSilentOnlyWhileItIsDue) {
  Pulse pulse;
  PulseWatch watch;
  pulse.begin();
  EXPECT_FALSE(watch.finds_silence(0, kMaxNs));
  EXPECT_FALSE(watch.finds_silence(9999, kMaxNs)) << "it never beat";
  pulse.beat();
  EXPECT_FALSE(watch.finds_silence(10'000, kMaxNs));
  EXPECT_FALSE(watch.finds_silence(11'000, kMaxNs));
  EXPECT_TRUE(watch.finds_silence(11'001, kMaxNs));
  pulse.beat();
  EXPECT_FALSE(watch.finds_silence(12'000, kMaxNs)) << "it beat again";
  pulse.rest();
  EXPECT_FALSE(watch.finds_silence(99'000, kMaxNs));
}

TEST(Pulse, FindsTheOneThatIsSilentAmongOthers) {
  Pulse silent;
  Pulse alive;
  PulseWatch watch;
  silent.begin();
  alive.begin();
  silent.beat();
  for (std::int64_t now_ns = 0; now_ns <= kMaxNs; now_ns += 100) {
    alive.beat();
    EXPECT_FALSE(watch.finds_silence(now_ns, kMaxNs));
  }
  alive.beat();
  EXPECT_TRUE(watch.finds_silence(kMaxNs + 1, kMaxNs));
}

// The next owner of a place beats as often as the one before.
TEST(Pulse, AnotherOwnerOfAPlaceIsAlive) {
  PulseWatch watch;
  for (std::int64_t now_ns = 0; now_ns < 10 * kMaxNs; now_ns += kMaxNs) {
    Pulse pulse;
    pulse.begin();
    pulse.beat();
    EXPECT_FALSE(watch.finds_silence(now_ns, kMaxNs / 2));
  }
  EXPECT_FALSE(watch.finds_silence(99 * kMaxNs, kMaxNs)) << "nobody is left";
}

TEST(Pulse, ATableThatIsFullHidesTheRest) {
  std::vector<Pulse> all(kMaxPulses + 1);
  for (Pulse& pulse : all) pulse.begin();
  all.back().beat();  // has no place
  all.pop_back();
  PulseWatch watch;
  EXPECT_FALSE(watch.finds_silence(0, kMaxNs));
  EXPECT_FALSE(watch.finds_silence(9999, kMaxNs));
  all.back().beat();
  EXPECT_FALSE(watch.finds_silence(10'000, kMaxNs));
  EXPECT_TRUE(watch.finds_silence(20'000, kMaxNs));
}

TEST(Pulse, MovesWithItsPlace) {
  Pulse first;
  first.begin();
  first.beat();
  PulseWatch watch;
  EXPECT_FALSE(watch.finds_silence(0, kMaxNs));
  {
    const Pulse second = std::move(first);
    EXPECT_TRUE(watch.finds_silence(2000, kMaxNs));
  }
  EXPECT_FALSE(watch.finds_silence(9000, kMaxNs));
}

}  // namespace
}  // namespace hapticwall
