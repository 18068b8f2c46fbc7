#include "tests/soak/watched_clock.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace hapticwall::soak {
namespace {

constexpr auto kNanoseconds = static_cast<long double>(session::kNanosecondsPerSecond);

// How long the loop looks for its owner, in real time.
constexpr std::chrono::milliseconds kPatience{2};

}  // namespace

void WatchedClock::watch(std::int64_t deadline_ns) {
  if (!first_known_) {
    first_known_ = true;
    first_ns_ = deadline_ns;
  }
  const auto since_ns = static_cast<long double>(deadline_ns - first_ns_);
  const long double periods = std::roundl(since_ns * rate_hz_ / kNanoseconds);
  const auto off_ns = static_cast<double>(since_ns - periods * kNanoseconds / rate_hz_);
  worst_phase_ns_.store(std::max(worst_phase_ns(), std::abs(off_ns)), std::memory_order_relaxed);
  periods_.store(static_cast<std::uint64_t>(periods), std::memory_order_release);
}

void RealClock::sleep_until_ns(std::int64_t deadline_ns) {
  watch(deadline_ns);
  clock_.sleep_until_ns(deadline_ns);
}

void RealClock::pass(std::int64_t duration_ns) {
  std::this_thread::sleep_for(std::chrono::nanoseconds(duration_ns));
}

// Up to 100 us; one in about a thousand up to 20 ms.
std::int64_t VirtualClock::lateness_ns() {
  constexpr std::uint64_t kUsualNs = 100'000;
  constexpr std::uint64_t kRareNs = 20'000'000;
  constexpr std::uint64_t kUsualToRare = 1024;
  const std::uint64_t draw = random_();
  const std::uint64_t most_ns = draw % kUsualToRare == 0 ? kRareNs : kUsualNs;
  return static_cast<std::int64_t>(draw / kUsualToRare % most_ns);
}

void VirtualClock::sleep_until_ns(std::int64_t deadline_ns) {
  watch(deadline_ns);
  std::unique_lock lock(mutex_);
  wanted_ns_ = deadline_ns;
  if (deadline_ns > granted_ns_) {
    changed_.notify_all();
    changed_.wait_for(lock, kPatience, [&] { return deadline_ns <= granted_ns_; });
  }
  now_ns_.store(std::max(now_ns(), deadline_ns + lateness_ns()), std::memory_order_relaxed);
}

void VirtualClock::pass(std::int64_t duration_ns) {
  std::unique_lock lock(mutex_);
  granted_ns_ = std::max(granted_ns_, now_ns()) + duration_ns;
  changed_.notify_all();
  changed_.wait_for(lock, std::chrono::seconds(1), [&] { return wanted_ns_ > granted_ns_; });
}

}  // namespace hapticwall::soak
