// The samples between the sound's thread and the card's.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/session/loop/spsc_queue.h"

namespace hapticwall::sound {

// The level that the ring is kept at, in samples.
struct RingLevels {
  std::size_t start = 0;  // level before the card's first sample, and after the ring was empty
  std::size_t max = 0;    // level above which the oldest samples are dropped, down to `start`
  double mean = 0.0;      // seen between two calls of the card
};

inline constexpr std::size_t kRingCapacity = 1U << 14U;

// One thread pushes, the card's thread fills. Neither waits.
class SoundRing {
 public:
  // Sets the levels before the first push(); until then the card gets silence.
  void plan(const RingLevels& levels);

  // False if it is full. Realtime-safe: yes.
  bool push(float sample) { return samples_.try_push(sample); }
  [[nodiscard]] std::size_t size() const { return samples_.size(); }
  [[nodiscard]] bool playing() const { return playing_.load(std::memory_order_relaxed); }
  // How often the card has asked.
  [[nodiscard]] std::uint64_t calls() const { return calls_.load(std::memory_order_relaxed); }

  // The card's thread. An empty ring fades out, a full one fades in: no step is heard.
  // Realtime-safe: yes.
  void fill(std::span<float> out);

 private:
  [[nodiscard]] bool ready();

  session::SpscQueue<float> samples_{kRingCapacity};
  std::atomic<std::size_t> start_{kRingCapacity + 1};
  std::atomic<std::size_t> max_{kRingCapacity + 1};
  std::atomic<bool> playing_{false};
  std::atomic<std::uint64_t> calls_{0};
  float fade_ = 0.0F;  // 0 to 1
  float last_ = 0.0F;
};

}  // namespace hapticwall::sound
