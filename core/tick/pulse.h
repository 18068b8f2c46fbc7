// Signs of life of code that may hang: a loop, a call into a library. They stand in one table of
// atomic numbers, so that a signal handler can look at all of them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace hapticwall {

// Places in the table; without a free one a pulse is not seen.
inline constexpr std::size_t kMaxPulses = 256;

// One place in the table. One thread at a time. Realtime-safe: yes, all of it.
class Pulse {
 public:
  Pulse() = default;  // has no place
  Pulse(Pulse&& other) noexcept : place_(std::exchange(other.place_, nullptr)) {}
  Pulse& operator=(Pulse&& other) noexcept {
    std::swap(place_, other.place_);
    return *this;
  }
  ~Pulse();

  // Takes a place, if it has none.
  void begin() noexcept;
  // Announces that another beat or a rest is due.
  void beat() noexcept { go_on(kBeats); }
  // Nothing is due.
  void rest() noexcept { go_on(kRests); }

 private:
  friend class PulseWatch;
  // The lowest bits of a place; the others count the changes.
  static constexpr std::uint64_t kFree = 0;
  static constexpr std::uint64_t kRests = 1;
  static constexpr std::uint64_t kBeats = 2;
  static constexpr std::uint64_t kStates = 4;

  // Only the owner changes a place that is taken.
  void go_on(std::uint64_t state) noexcept {
    if (place_ == nullptr) return;
    const std::uint64_t before = place_->load(std::memory_order_relaxed);
    place_->store((before | (kStates - 1)) + 1 + state, std::memory_order_release);
  }

  std::atomic<std::uint64_t>* place_ = nullptr;
};

// Compares the table with earlier looks at it.
class PulseWatch {
 public:
  // True if a pulse that is due has not changed for this long. `now_ns`: of any monotonic clock. A
  // signal handler may call it. Realtime-safe: yes.
  [[nodiscard]] bool finds_silence(std::int64_t now_ns, std::int64_t max_silence_ns) noexcept;

 private:
  struct Seen {
    std::uint64_t value = 0;
    std::int64_t since_ns = 0;
  };
  std::array<Seen, kMaxPulses> seen_{};
};

}  // namespace hapticwall
