// The velocity of the handle, estimated from its measured positions: one table entry an estimator,
// built as those of the algorithms.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <string_view>
#include <type_traits>

#include "core/estimator/backward_difference.h"

namespace hapticwall {

inline constexpr std::size_t kMaxEstimatorBytes = 256;

// Realtime-safe: yes, all functions.
struct Estimator {
  std::string_view name;
  void (*start)(void* state);  // without a past
  void (*configure)(void* state, double rate_hz);
  void (*reset)(void* state);  // forgets the past
  // v_k, m/s. `displacement_m`: since the last tick; 0 in the first tick and after a faulty
  // reading.
  double (*velocity)(void* state, double position_m, double displacement_m);
};

// Of a struct with kName and the three functions, as BackwardDifference.
template <class Struct>
[[nodiscard]] constexpr Estimator estimator_of() {
  static_assert(sizeof(Struct) <= kMaxEstimatorBytes &&
                alignof(Struct) <= alignof(std::max_align_t));
  static_assert(std::is_trivially_copyable_v<Struct> && std::is_trivially_destructible_v<Struct>);
  return {Struct::kName, [](void* state) { new (state) Struct{}; },
          [](void* state, double rate_hz) { static_cast<Struct*>(state)->configure(rate_hz); },
          [](void* state) { static_cast<Struct*>(state)->reset(); },
          [](void* state, double position_m, double displacement_m) {
            return static_cast<Struct*>(state)->velocity(position_m, displacement_m);
          }};
}

// One estimator on one axis. Realtime-safe: yes, all of it.
class ActiveEstimator {
 public:
  // nullptr: the backward difference, without a call. Another estimator than before starts anew.
  void configure(const Estimator* estimator, double rate_hz) {
    if (estimator != nullptr && estimator != other_) estimator->start(block_.data());
    other_ = estimator;
    difference_.configure(rate_hz);
    if (other_ != nullptr) other_->configure(block_.data(), rate_hz);
  }
  void reset() {
    if (other_ != nullptr) other_->reset(block_.data());
  }
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
