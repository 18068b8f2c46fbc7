// A law's Parameters<double> or State<double> as LawNumbers, and back.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// Number of members of a law's struct.
template <class Struct>
inline constexpr std::size_t kLawNumbers = std::is_empty_v<Struct>
                                               ? 0
                                               : sizeof(Struct) / sizeof(double);

// Realtime-safe: yes, both.
template <class Struct>
[[nodiscard]] LawNumbers to_numbers(const Struct& values) {
  static_assert(kLawNumbers<Struct> <= kMaxLawNumbers);
  LawNumbers numbers{};
  std::memcpy(numbers.data(), &values, kLawNumbers<Struct> * sizeof(double));
  return numbers;
}
template <class Struct>
[[nodiscard]] Struct from_numbers(const LawNumbers& numbers) {
  Struct values;
  std::memcpy(&values, numbers.data(), kLawNumbers<Struct> * sizeof(double));
  return values;
}

// A law with its parameters and state: inlined into the loop that holds it.
template <class Law>
class InlinedLaw {
 public:
  // `walls` must outlive it.
  InlinedLaw(const LawNumbers& parameters, const LawNumbers& state, const WallSet& walls)
      : parameters_(from_numbers<typename Law::template Parameters<double>>(parameters)),
        state_(from_numbers<typename Law::template State<double>>(state)),
        walls_(walls) {}

  [[nodiscard]] double step(const StabiliserInput& input) {
    return Law::step(parameters_, state_, walls_, input);
  }
  [[nodiscard]] const WallSet& walls() const { return walls_; }
  [[nodiscard]] LawNumbers parameters() const { return to_numbers(parameters_); }
  [[nodiscard]] LawNumbers state() const { return to_numbers(state_); }

 private:
  typename Law::template Parameters<double> parameters_;
  typename Law::template State<double> state_;
  const WallSet& walls_;
};

}  // namespace hapticwall
