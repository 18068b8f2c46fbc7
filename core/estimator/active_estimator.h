// An estimator at work.
#pragma once

#include <array>
#include <cstddef>

#include "core/estimator/backward_difference.h"

namespace hapticwall {

// One estimator on one axis. Realtime-safe: yes, all of it.
class ActiveEstimator {
 public:
  // nullptr: the backward difference, without a call. Another estimator than before starts anew.
  void configure(const Estimator* estimator, const EstimatorContext& context) {
    if (estimator != nullptr && estimator != other_) estimator->start(block_.data());
    other_ = estimator;
    difference_.configure(context);
    if (other_ != nullptr) other_->configure(block_.data(), context);
  }
  // Forgets the past, and keeps estimator and parameters.
  void reset() {
    if (other_ != nullptr) other_->reset(block_.data());
  }
  // The velocity, m/s. Call it once a tick: an estimator may keep the past.
  [[nodiscard]] double velocity(double position_m, double displacement_m) {
    if (other_ == nullptr) [[likely]]
      return difference_.velocity(position_m, displacement_m);
    return other_->velocity(block_.data(), position_m, displacement_m);
  }

 private:
  const Estimator* other_ = nullptr;
  BackwardDifference difference_;
  alignas(std::max_align_t) std::array<std::byte, kMaxEstimatorBytes> block_{};
};

}  // namespace hapticwall
