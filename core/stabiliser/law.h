// The vocabulary of the laws.
//
// A law is written once and compiled several times: here for single numbers, and in
// core/batch/lane_law-inl.h for vectors with one scene per lane, once for each instruction set.
// Its file therefore stands between HAPTICWALL_LAW_BEGIN and HAPTICWALL_LAW_END, has no include
// guard, and combines numbers with + - * / and the functions below only. Both vocabularies round
// alike and agree on the sign of zero, so that a lane gives the bits of simulate().
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/stabiliser/stabiliser.h"
#include "core/wall.h"

#define HAPTICWALL_LAW_BEGIN namespace hapticwall::scalar {
#define HAPTICWALL_LAW_END }

// Realtime-safe: yes, all of it.
namespace hapticwall::scalar {

using Number = double;
using Flags = bool;  // one per number
using LawInput = StabiliserInput;
using Walls = WallSet;
using Wall = WallSettings;
inline constexpr std::size_t kLawWalls = kMaxWalls;  // Walls has at most this many

[[nodiscard]] inline Number number(double value) { return value; }
[[nodiscard]] inline Number select(Flags flags, Number yes, Number no) { return flags ? yes : no; }
// The value, or 0.
[[nodiscard]] inline Number or_zero(Flags flags, Number value) { return flags ? value : 0.0; }
[[nodiscard]] inline Flags greater(Number a, Number b) { return a > b; }
[[nodiscard]] inline Flags at_most(Number a, Number b) { return a <= b; }
[[nodiscard]] inline Flags equals(Number a, Number b) { return a == b; }
[[nodiscard]] inline Flags differs(Number a, Number b) { return a != b; }
[[nodiscard]] inline Flags both(Flags a, Flags b) { return a && b; }
[[nodiscard]] inline Flags either(Flags a, Flags b) { return a || b; }
// True allows an early return. Lanes always go on, so what follows must not depend on it.
[[nodiscard]] inline bool none(Flags flags) { return !flags; }

[[nodiscard]] inline Number minus(Number a) { return -a; }
[[nodiscard]] inline Number abs_of(Number a) { return std::abs(a); }
[[nodiscard]] inline Number root(Number a) { return std::sqrt(a); }
[[nodiscard]] inline Number with_sign(Number size, Number sign) {
  return std::copysign(size, sign);
}
// The first of two equal numbers: std::max(+0, -0) is +0.
[[nodiscard]] inline Number larger(Number a, Number b) { return a < b ? b : a; }
[[nodiscard]] inline Number smaller(Number a, Number b) { return b < a ? b : a; }
[[nodiscard]] inline Number positive_part(Number a) { return 0.0 < a ? a : 0.0; }

// F_e of walls that the law evaluates elsewhere than at the present position.
[[nodiscard]] inline Number wall_force(const Walls& walls, Number position_m,
                                       Number velocity_m_per_s) {
  return evaluate_walls(walls, position_m, velocity_m_per_s).force_n;
}
using hapticwall::spring_force;

}  // namespace hapticwall::scalar
