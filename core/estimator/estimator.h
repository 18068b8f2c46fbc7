// The velocity of the handle, estimated from its measured positions: the contract of an estimator,
// and the list. An estimator is a struct in a file of this folder and a line in estimator_list.cpp:
//
//   struct Name {
//     static constexpr EstimatorDescription kDescription{...};
//
//     // Takes rate and parameters, and keeps the past.
//     void configure(const EstimatorContext& context);
//     // Forgets the past, and keeps the parameters.
//     void reset();
//     // v_k, m/s. `displacement_m`: x_k - x_{k-1}; 0 in the first tick and after a faulty reading.
//     double velocity(double position_m, double displacement_m);
//   };
//
// All three are realtime-safe: bounded time, no allocation, no lock, no system call. Optional, for
// set-up and display:
//
//     // The transfer function of a linear estimator, which the limits of stability read.
//     static VelocityTransfer transfer(const EstimatorContext& context);
//     // Numbers that follow from the parameters, for people.
//     static DerivedNumbers numbers(const EstimatorContext& context);
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/estimator/velocity_transfer.h"
#include "core/estimator_settings.h"

namespace hapticwall {

// The part of a scene that an estimator may use.
struct EstimatorContext {
  double rate_hz = 1000.0;
  double encoder_m = 0.0;  // 0: none
  const EstimatorSettings* settings = nullptr;

  // The value of a key if the scene names it. Realtime-safe: yes.
  [[nodiscard]] std::optional<double> value(std::string_view key) const;
  [[nodiscard]] double value_or(std::string_view key, double fallback) const {
    return value(key).value_or(fallback);
  }
};

using EstimatorDescription = PartDescription;

struct DerivedNumber {
  std::string_view name;  // "": none
  double value = 0.0;
  std::string_view unit;
};
using DerivedNumbers = std::array<DerivedNumber, 2>;

// Room for the state in place, so that a change of estimator allocates nothing.
inline constexpr std::size_t kMaxEstimatorBytes = 512;

// The functions of an estimator on a block of kMaxEstimatorBytes, aligned for any type.
struct Estimator {
  EstimatorDescription description;
  void (*start)(void* state);  // without parameters and past
  void (*configure)(void* state, const EstimatorContext& context);
  void (*reset)(void* state);
  double (*velocity)(void* state, double position_m, double displacement_m);
  VelocityTransfer (*transfer)(const EstimatorContext& context) = nullptr;  // nullptr: nonlinear
  DerivedNumbers (*numbers)(const EstimatorContext& context) = nullptr;     // nullptr: none
};

// The functions of a struct. It is trivially copyable, because the next estimator starts in the
// same block without a destructor call.
template <class Struct>
[[nodiscard]] constexpr Estimator estimator_of() {
  static_assert(sizeof(Struct) <= kMaxEstimatorBytes);
  static_assert(alignof(Struct) <= alignof(std::max_align_t));
  static_assert(std::is_trivially_copyable_v<Struct> && std::is_trivially_destructible_v<Struct>);
  Estimator estimator{Struct::kDescription, [](void* state) { new (state) Struct{}; },
                      [](void* state, const EstimatorContext& context) {
                        static_cast<Struct*>(state)->configure(context);
                      },
                      [](void* state) { static_cast<Struct*>(state)->reset(); },
                      [](void* state, double position_m, double displacement_m) {
                        return static_cast<Struct*>(state)->velocity(position_m, displacement_m);
                      }};
  if constexpr (requires(const EstimatorContext& context) { Struct::transfer(context); })
    estimator.transfer = &Struct::transfer;
  if constexpr (requires(const EstimatorContext& context) { Struct::numbers(context); })
    estimator.numbers = &Struct::numbers;
  return estimator;
}

// The closed list; the first one is the backward difference. Realtime-safe: yes, all.
[[nodiscard]] std::span<const Estimator> estimators();
// nullopt for a name outside of the list.
[[nodiscard]] std::optional<std::size_t> find_estimator(std::string_view name);
// Union of all estimators' keys, each once; EstimatorSettings::values has this order.
[[nodiscard]] std::span<const ParameterDescription> estimator_parameters();
// nullptr for the backward difference, which the tick computes without a call.
[[nodiscard]] const Estimator* chosen_estimator(const EstimatorSettings& settings);
// The transfer function of the estimator that `context.settings` names; nullopt if it is not
// linear.
[[nodiscard]] std::optional<VelocityTransfer> velocity_transfer(const EstimatorContext& context);

}  // namespace hapticwall
