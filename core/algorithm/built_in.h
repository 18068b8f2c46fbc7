// A built-in algorithm is a struct in a file of this folder and a line in algorithm_list.cpp:
//
//   struct Name {
//     static constexpr AlgorithmDescription kDescription{...};
//
//     // Takes parameters and walls, and keeps the past.
//     void configure(const AlgorithmContext& context);
//     // Forgets the past, and keeps the parameters.
//     void reset();
//     // F_d(k), newtons. `signals`: a number for each of kDescription.signals. Each is NaN before
//     // the call; one that stays so is not shown.
//     double step(const AlgorithmInput& in, std::span<double> signals);
//   };
//
// All three are realtime-safe: O(1), no allocation, no lock, no system call. step() may return any
// number; the servo step makes it finite and clamps it.
#pragma once

#include <cstddef>
#include <new>
#include <span>
#include <type_traits>

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// The functions of a struct. It is trivially copyable, because the next algorithm starts in the
// same block without a destructor call.
template <class Struct>
[[nodiscard]] constexpr Algorithm algorithm_of() {
  static_assert(sizeof(Struct) <= kMaxAlgorithmBytes);
  static_assert(alignof(Struct) <= alignof(std::max_align_t));
  static_assert(std::is_trivially_copyable_v<Struct> && std::is_trivially_destructible_v<Struct>);
  return {Struct::kDescription, [](void* state) { new (state) Struct{}; },
          [](void* state, const AlgorithmContext& context) {
            static_cast<Struct*>(state)->configure(context);
          },
          [](void* state) { static_cast<Struct*>(state)->reset(); },
          [](void* state, const AlgorithmInput& in, std::span<double> signals) {
            return static_cast<Struct*>(state)->step(in, signals);
          }};
}

}  // namespace hapticwall
