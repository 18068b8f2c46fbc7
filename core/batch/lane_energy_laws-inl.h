// More of the stabilising algorithms on lanes: those that bound by energy, and the prediction. The
// conventions are those of lane_laws-inl.h.
#if defined(HAPTICWALL_LANE_ENERGY_LAWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_ENERGY_LAWS_INL_H_
#undef HAPTICWALL_LANE_ENERGY_LAWS_INL_H_
#else
#define HAPTICWALL_LANE_ENERGY_LAWS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "core/batch/lane_block.h"
#include "core/batch/lane_laws-inl.h"
#include "core/batch/lane_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

// core/stabiliser/energy_bounding_2010.h. Parameters: c₁, c₂.
struct EnergyBounding2010Law {
  static constexpr bool kOnlyPushes = false;

  HWY_INLINE void load_state(const LaneMotion&, std::size_t) {}
  HWY_INLINE void store_state(LaneMotion&, std::size_t) const {}
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector zero = hn::Zero(kTag);
    const Vector moved_m = hn::Abs(input.displacement_m);
    const Vector sign = hn::CopySign(constant(1.0), input.displacement_m);
    const Vector before_n = sign * input.previous_force_n;
    const Vector step_n = load(parameters.law[0], first_lane) * moved_m;
    const Vector a_n = load(parameters.law[1], first_lane) * moved_m;
    const Vector sum_n = a_n + hypotenuse(a_n, hn::Abs(before_n));
    const Vector lent_n = hn::IfThenElseZero(hn::Gt(sum_n, zero), before_n * (before_n / sum_n));
    const Vector least_n = hn::Max(before_n - step_n, zero - lent_n);
    const Vector most_n = hn::Min(before_n + step_n, sum_n);
    const Vector wanted_n = sign * input.wall_force_n;
    const Vector force_n = sign * hn::Min(hn::Max(wanted_n, least_n), most_n);
    return hn::IfThenElse(hn::Gt(moved_m, zero), force_n, input.previous_force_n);
  }

 private:
  [[nodiscard]] static HWY_INLINE Vector hypotenuse(Vector a, Vector b) {
    const Vector large = hn::Max(a, b);
    const Vector ratio = hn::Min(a, b) / large;
    return hn::IfThenElseZero(hn::Gt(large, hn::Zero(kTag)),
                              large * hn::Sqrt(constant(1.0) + ratio * ratio));
  }
};

// core/stabiliser/force_bounding.h. Parameter: b/T. State: E.
struct ForceBoundingLaw {
  static constexpr bool kOnlyPushes = true;
  Vector energy_j;

  HWY_INLINE void load_state(const LaneMotion& motion, std::size_t first_lane) {
    energy_j = load(motion.law[0], first_lane);
  }
  HWY_INLINE void store_state(LaneMotion& motion, std::size_t first_lane) const {
    store(energy_j, motion.law[0], first_lane);
  }
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector damping_n_per_m = load(parameters.law[0], first_lane);
    energy_j = hn::IfThenZeroElse(hn::Eq(input.previous_force_n, hn::Zero(kTag)), energy_j);
    energy_j = energy_j + damping_n_per_m * (input.displacement_m * input.displacement_m) +
               input.previous_force_n * input.displacement_m;
    const Vector bound_n = hn::Sqrt(constant(4.0) * damping_n_per_m * positive_part(energy_j));
    return hn::Min(input.wall_force_n, bound_n);
  }
};

// core/stabiliser/half_sample.h with one wall.
struct HalfSampleLaw {
  static constexpr bool kOnlyPushes = true;

  HWY_INLINE void load_state(const LaneMotion&, std::size_t) {}
  HWY_INLINE void store_state(LaneMotion&, std::size_t) const {}
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector ahead_m = input.position_m + constant(0.5) * input.displacement_m;
    const Vector penetration_m = ahead_m - load(parameters.wall_m, first_lane);
    const Vector pushed_n =
        positive_part(load(parameters.wall_stiffness_n_per_m, first_lane) * penetration_m +
                      load(parameters.wall_damping_n_s_per_m, first_lane) * input.velocity_m_per_s);
    return hn::IfThenElseZero(hn::Gt(penetration_m, hn::Zero(kTag)), pushed_n);
  }
};

// core/stabiliser/energy_bookkeeping.cpp with one wall. Parameter: 2b/T. State: H.
struct EnergyBookkeepingLaw {
  static constexpr bool kOnlyPushes = true;
  Vector energy_j;

  HWY_INLINE void load_state(const LaneMotion& motion, std::size_t first_lane) {
    energy_j = load(motion.law[0], first_lane);
  }
  HWY_INLINE void store_state(LaneMotion& motion, std::size_t first_lane) const {
    store(energy_j, motion.law[0], first_lane);
  }
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector put_in_j = energy_j + input.previous_force_n * input.displacement_m;
    energy_j = hn::IfThenElseZero(input.in_contact, put_in_j);
    const Vector spring_n =
        hn::Sqrt(constant(2.0) * load(parameters.wall_stiffness_n_per_m, first_lane) *
                 positive_part(energy_j));
    const Vector passive_n = load(parameters.law[0], first_lane) * input.penetration_m;
    return hn::Min(input.wall_force_n, hn::Max(passive_n, spring_n));
  }
};

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_ENERGY_LAWS_INL_H_
