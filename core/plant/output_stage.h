// Between command and amplifier: rounding to whole steps of force, the actuator's limit, a delay of
// whole ticks, and noise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/chance.h"
#include "core/encoder.h"
#include "core/scene.h"

namespace hapticwall {

// Realtime-safe: yes, after construction.
class OutputStage {
 public:
  // Of axis x.
  explicit OutputStage(const Scene& scene)
      : resolution_n_(scene.x().device.force_resolution_n.value_or(0.0)),
        limit_n_(scene.x().device.force_limit_n.value_or(std::numeric_limits<double>::max())),
        noise_n_(scene.x().device.force_noise_n.value_or(0.0)),
        chance_(scene.sampling.seed.value_or(1), scene.first_axis, Purpose::kForceNoise),
        waiting_n_(static_cast<std::size_t>(scene.x().device.delay_ticks.value_or(0)), 0.0) {}

  // False: pass() returns its argument.
  [[nodiscard]] bool present() const {
    return resolution_n_ > 0.0 || noise_n_ > 0.0 || !waiting_n_.empty();
  }

  // Takes this tick's command and returns the amplifier's command of this tick, newtons; 0 before
  // the first delayed command arrives.
  [[nodiscard]] double pass(double commanded_n) {
    double force_n = commanded_n;
    if (resolution_n_ > 0.0) {
      force_n = std::clamp(quantise(commanded_n, resolution_n_), -limit_n_, limit_n_);
    }
    if (!waiting_n_.empty()) {
      std::swap(force_n, waiting_n_[next_]);
      next_ = next_ + 1 == waiting_n_.size() ? 0 : next_ + 1;
    }
    if (noise_n_ > 0.0) force_n += noise_n_ * chance_.normal(tick_++);
    last_n_ = force_n;
    return force_n;
  }
  // The last return value of pass(), or 0.
  [[nodiscard]] double last_n() const { return last_n_; }

  // Forgets the commands on their way: pass() returns 0 until the first new one arrives.
  void reset() {
    std::fill(waiting_n_.begin(), waiting_n_.end(), 0.0);
    next_ = 0;
    last_n_ = 0.0;
    tick_ = 0;
  }

  // Continues from another stage whose last output was `last_n`. Its delayed commands arrive, at
  // most one delay later; if this delay is longer, `last_n` holds for the difference.
  void take_over(const OutputStage& other, double last_n) {
    reset();
    last_n_ = last_n;
    tick_ = other.tick_;
    const std::size_t count = waiting_n_.size();
    const std::size_t theirs = other.waiting_n_.size();
    for (std::size_t age = 0; age < count; ++age) {  // 0: the newest
      waiting_n_[count - 1 - age] =
          age < theirs ? other.waiting_n_[(other.next_ + theirs - 1 - age) % theirs] : last_n_;
    }
  }

 private:
  double resolution_n_;  // 0: none
  double limit_n_;
  double noise_n_;  // standard deviation; 0: none
  Chance chance_;
  std::uint64_t tick_ = 0;         // of the next noise
  std::vector<double> waiting_n_;  // a ring; the oldest at next_
  std::size_t next_ = 0;
  double last_n_ = 0.0;
};

}  // namespace hapticwall
