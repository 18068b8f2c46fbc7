// The vocabulary of the laws (core/stabiliser/law.h) for vectors of one scene per lane, each with
// one wall, and then the law of HAPTICWALL_LAW_FILE itself. Compiled once per instruction set.
//
// The includer has included the law's file before for single numbers, so that no header is read
// here under the target's options.
#if defined(HAPTICWALL_LANE_LAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_LAW_INL_H_
#undef HAPTICWALL_LANE_LAW_INL_H_
#else
#define HAPTICWALL_LANE_LAW_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "core/batch/lane_block.h"
#include "core/batch/lane_vector-inl.h"
#include "core/stabiliser/law.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

using Number = Vector;
using LawInput = BasicStabiliserInput<Vector, Flags>;
inline constexpr std::size_t kLawWalls = 1;

struct Wall {
  Number position_m, stiffness_n_per_m, damping_n_s_per_m;
};
struct Walls {
  Wall wall;

  [[nodiscard]] static constexpr std::size_t count() { return kLawWalls; }
  [[nodiscard]] HWY_INLINE const Wall& operator[](std::size_t /*i*/) const { return wall; }
  [[nodiscard]] HWY_INLINE Number contacts(Number /*position_m*/) const { return constant(1.0); }
};

HWY_INLINE Number number(double value) { return constant(value); }
HWY_INLINE Number select(Flags flags, Number yes, Number no) {
  return hn::IfThenElse(flags, yes, no);
}
HWY_INLINE Number or_zero(Flags flags, Number value) { return hn::IfThenElseZero(flags, value); }
HWY_INLINE Flags greater(Number a, Number b) { return hn::Gt(a, b); }
HWY_INLINE Flags at_most(Number a, Number b) { return hn::Le(a, b); }
HWY_INLINE Flags equals(Number a, Number b) { return hn::Eq(a, b); }
HWY_INLINE Flags differs(Number a, Number b) { return hn::Ne(a, b); }
HWY_INLINE Flags both(Flags a, Flags b) { return hn::And(a, b); }
HWY_INLINE Flags either(Flags a, Flags b) { return hn::Or(a, b); }
HWY_INLINE constexpr bool none(Flags /*flags*/) { return false; }
HWY_INLINE Number minus(Number a) { return hn::Neg(a); }
HWY_INLINE Number abs_of(Number a) { return hn::Abs(a); }
HWY_INLINE Number root(Number a) { return hn::Sqrt(a); }
HWY_INLINE Number with_sign(Number size, Number sign) { return hn::CopySign(size, sign); }

HWY_INLINE Number wall_force(const Walls& walls, Number position_m, Number velocity_m_per_s) {
  const Number penetration_m = position_m - walls.wall.position_m;
  return or_zero(greater(penetration_m, number(0.0)),
                 positive_part(walls.wall.stiffness_n_per_m * penetration_m +
                               walls.wall.damping_n_s_per_m * velocity_m_per_s));
}
HWY_INLINE Number spring_force(const Walls& walls, Number energy_j) {
  return root(number(2.0) * walls.wall.stiffness_n_per_m * energy_j);
}

}  // namespace hapticwall::batch::HWY_NAMESPACE

#undef HAPTICWALL_LAW_BEGIN
#define HAPTICWALL_LAW_BEGIN namespace hapticwall::batch::HWY_NAMESPACE {
#include HAPTICWALL_LAW_FILE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_LAW_INL_H_
