// The newest value from one thread to another, without a lock: three slots and one atomic byte.
//
// The producer writes one slot, the consumer reads another, and the third lies between them. Each
// side exchanges its slot for the middle one, so a value is read whole or not at all. A slow
// consumer sees the newest value and misses earlier ones. The producer can withdraw a value that
// the consumer has not seen.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace hapticwall {

// Keeps what two threads write apart, so that neither slows the other down.
inline constexpr std::size_t kCacheLineBytes = 64;

// One producer thread, one consumer thread. Realtime-safe: yes, every member.
template <typename T>
class TripleBuffer {
  static_assert(std::is_trivially_copyable_v<T>, "copies must not allocate, lock or throw");
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

 public:
  explicit TripleBuffer(const T& initial = T{}) {
    for (Slot& slot : slots_) slot.value = initial;
  }
  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  // Producer only: makes `value` the newest one.
  void publish(const T& value) {
    slots_[back_].value = value;
    const auto fresh = static_cast<std::uint8_t>(back_ | kFreshBit);
    back_ = middle_.exchange(fresh, std::memory_order_acq_rel) & kIndexMask;
  }

  // Producer only: withdraws the newest value. True: the consumer had not seen it and never will.
  // False: the consumer has seen everything published.
  bool withdraw() {
    const std::uint8_t previous = middle_.exchange(back_, std::memory_order_acq_rel);
    back_ = previous & kIndexMask;
    return (previous & kFreshBit) != 0;
  }

  // Consumer only: moves on to the newest value. False without a new value since the last call, or
  // during an exchange by the producer (the next call then finds the value).
  bool update() {
    std::uint8_t middle = middle_.load(std::memory_order_relaxed);
    if ((middle & kFreshBit) == 0) return false;
    // Only a value that is still fresh: the producer may have withdrawn it since the look.
    if (!middle_.compare_exchange_strong(middle, front_, std::memory_order_acq_rel,
                                         std::memory_order_relaxed)) {
      return false;
    }
    front_ = middle & kIndexMask;
    return true;
  }

  // Consumer only: the value that the last update() moved to, or the initial one.
  [[nodiscard]] const T& current() const { return slots_[front_].value; }

 private:
  static constexpr std::uint8_t kIndexMask = 3;
  static constexpr std::uint8_t kFreshBit = 4;

  struct alignas(kCacheLineBytes) Slot {
    T value;
  };

  std::array<Slot, 3> slots_;
  alignas(kCacheLineBytes) std::uint8_t back_ = 0;                 // the producer's
  alignas(kCacheLineBytes) std::atomic<std::uint8_t> middle_ = 1;  // index, and whether it is fresh
  alignas(kCacheLineBytes) std::uint8_t front_ = 2;                // the consumer's
};

}  // namespace hapticwall
