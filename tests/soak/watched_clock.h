// The clocks of a soak: the machine's own, and one of which an hour passes in seconds. Both watch
// whether the loop's deadlines keep their phase.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <random>

#include "app/session/loop/clock.h"
#include "app/session/loop/realtime_setup.h"

namespace hapticwall::soak {

class WatchedClock : public session::Clock {
 public:
  explicit WatchedClock(double rate_hz) : rate_hz_(rate_hz) {}

  // How many periods lie between the first deadline and the one that is waited for now.
  [[nodiscard]] std::uint64_t periods() const { return periods_.load(std::memory_order_acquire); }
  // The furthest that a deadline was from its place in the first one's grid, in nanoseconds.
  [[nodiscard]] double worst_phase_ns() const {
    return worst_phase_ns_.load(std::memory_order_relaxed);
  }
  // The owner's turn is over: returns when about `duration_ns` have passed.
  virtual void pass(std::int64_t duration_ns) = 0;

 protected:
  // Called by the loop's thread, for every deadline that it waits for.
  void watch(std::int64_t deadline_ns);

 private:
  double rate_hz_;
  std::int64_t first_ns_ = 0;
  bool first_known_ = false;
  std::atomic<std::uint64_t> periods_{0};
  std::atomic<double> worst_phase_ns_{0.0};
};

class RealClock final : public WatchedClock {
 public:
  explicit RealClock(double rate_hz) : WatchedClock(rate_hz) {}

  [[nodiscard]] std::int64_t now_ns() override { return clock_.now_ns(); }
  void sleep_until_ns(std::int64_t deadline_ns) override;
  void pass(std::int64_t duration_ns) override;

 private:
  session::MonotonicClock clock_;
};

// Time passes as the owner lets it. Wake-ups come late, some by many periods, the same ones in
// every run. A loop whose owner is away goes on all the same, slowly: it never waits for anybody.
class VirtualClock final : public WatchedClock {
 public:
  explicit VirtualClock(double rate_hz) : WatchedClock(rate_hz) {}

  [[nodiscard]] std::int64_t now_ns() override { return now_ns_.load(std::memory_order_relaxed); }
  void sleep_until_ns(std::int64_t deadline_ns) override;
  void pass(std::int64_t duration_ns) override;

 private:
  [[nodiscard]] std::int64_t lateness_ns();

  std::atomic<std::int64_t> now_ns_{0};
  std::mt19937_64 random_{20261122};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t granted_ns_ = 0;
  std::int64_t wanted_ns_ = 0;  // deadline that the loop waits for
};

}  // namespace hapticwall::soak
