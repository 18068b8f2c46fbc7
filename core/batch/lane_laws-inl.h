// The stabilising algorithms on lanes: the same formulas as in core/stabiliser, with selections in
// the place of branches. Compiled once per instruction set (no include guard of its own by design
// of Highway's foreach_target.h). That they equal the scalar ones to the last bit is a test
// (tests/property/batch_lanes_test.cpp).
//
// A new one: a class here or in lane_energy_laws-inl.h, its name in LaneLaw and in with_law()
// (lane_kernel.cpp), its parameters in lane_scene.cpp. An algorithm without lanes needs nothing:
// its scenes run one by one.
#if defined(HAPTICWALL_LANE_LAWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_LAWS_INL_H_
#undef HAPTICWALL_LANE_LAWS_INL_H_
#else
#define HAPTICWALL_LANE_LAWS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "core/batch/lane_block.h"
#include "core/batch/lane_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

// What a law is told at a tick (core/stabiliser/stabiliser.h, StabiliserInput).
struct LawInput {
  Vector wall_force_n;
  Vector position_m;
  Vector displacement_m;
  Vector velocity_m_per_s;
  Vector penetration_m;
  Vector previous_force_n;
  Flags in_contact;
};

struct NoLaw {
  static constexpr bool kOnlyPushes = true;  // its force is never negative

  HWY_INLINE void load_state(const LaneMotion&, std::size_t) {}
  HWY_INLINE void store_state(LaneMotion&, std::size_t) const {}
  HWY_INLINE Vector step(const LaneParameters&, std::size_t, const LawInput& input) {
    return input.wall_force_n;
  }
};

// core/stabiliser/energy_bounding.h. Parameters: b, α_max.
struct EnergyBoundingLaw {
  static constexpr bool kOnlyPushes = false;

  HWY_INLINE void load_state(const LaneMotion&, std::size_t) {}
  HWY_INLINE void store_state(LaneMotion&, std::size_t) const {}
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector moving_bound_n =
        load(parameters.law[0], first_lane) * hn::Abs(input.velocity_m_per_s);
    const Flags moves = hn::Ne(input.velocity_m_per_s, hn::Zero(kTag));
    const Vector bound_n =
        hn::IfThenElse(moves, moving_bound_n, load(parameters.law[1], first_lane));
    const Vector wanted_step_n = input.wall_force_n - input.previous_force_n;
    const Vector bounded_n = input.previous_force_n + hn::CopySign(bound_n, wanted_step_n);
    return hn::IfThenElse(hn::Le(hn::Abs(wanted_step_n), bound_n), input.wall_force_n, bounded_n);
  }
};

// core/stabiliser/virtual_coupling.cpp with one wall. Parameters: K_c, (B + B_c)/T, K + K_c +
// (B + B_c)/T, T, B_c. State: the proxy's penetration.
struct VirtualCouplingLaw {
  static constexpr bool kOnlyPushes = true;
  Vector proxy_m;

  HWY_INLINE void load_state(const LaneMotion& motion, std::size_t first_lane) {
    proxy_m = load(motion.law[0], first_lane);
  }
  HWY_INLINE void store_state(LaneMotion& motion, std::size_t first_lane) const {
    store(proxy_m, motion.law[0], first_lane);
  }
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector coupling_n_per_m = load(parameters.law[0], first_lane);
    const Vector rate_n_per_m = load(parameters.law[1], first_lane);
    const Vector total_n_per_m = load(parameters.law[2], first_lane);
    const Vector period_s = load(parameters.law[3], first_lane);
    const Vector coupling_damping = load(parameters.law[4], first_lane);
    const Flags coupled = hn::And(input.in_contact, hn::Gt(total_n_per_m, hn::Zero(kTag)));
    const Vector moved_m =
        positive_part((coupling_n_per_m * input.penetration_m +
                       coupling_damping * input.velocity_m_per_s + rate_n_per_m * proxy_m) /
                      total_n_per_m);
    const Vector proxy_velocity = (moved_m - proxy_m) / period_s;
    const Vector force_n =
        positive_part(load(parameters.wall_stiffness_n_per_m, first_lane) * moved_m +
                      load(parameters.wall_damping_n_s_per_m, first_lane) * proxy_velocity);
    proxy_m = hn::IfThenElseZero(coupled, moved_m);
    return hn::IfThenElseZero(coupled, force_n);
  }
};

// core/stabiliser/passivity_control.cpp. Parameters: b, α_max, velocity floor, and 1 or 0 for
// held-force observer, damping credit, reset in free motion. State: E, credit, pending Δx.
struct PassivityControlLaw {
  static constexpr bool kOnlyPushes = false;
  Vector observed_j, credit_j, pending_m;

  HWY_INLINE void load_state(const LaneMotion& motion, std::size_t first_lane) {
    observed_j = load(motion.law[0], first_lane);
    credit_j = load(motion.law[1], first_lane);
    pending_m = load(motion.law[2], first_lane);
  }
  HWY_INLINE void store_state(LaneMotion& motion, std::size_t first_lane) const {
    store(observed_j, motion.law[0], first_lane);
    store(credit_j, motion.law[1], first_lane);
    store(pending_m, motion.law[2], first_lane);
  }
  HWY_INLINE Vector step(const LaneParameters& parameters, std::size_t first_lane,
                         const LawInput& input) {
    const Vector zero = hn::Zero(kTag);
    const Flags held_force = hn::Ne(load(parameters.law[3], first_lane), zero);
    const Flags credited = hn::Ne(load(parameters.law[4], first_lane), zero);
    const Flags forgets =
        hn::AndNot(input.in_contact, hn::Ne(load(parameters.law[5], first_lane), zero));
    const Vector velocity_times_step = hn::Abs(input.velocity_m_per_s * input.displacement_m);

    observed_j = observed_j + input.previous_force_n *
                                  hn::IfThenElse(held_force, input.displacement_m, pending_m);
    credit_j = credit_j + hn::IfThenElseZero(
                              credited, load(parameters.law[0], first_lane) * velocity_times_step);
    observed_j = hn::IfThenZeroElse(forgets, observed_j);
    credit_j = hn::IfThenZeroElse(forgets, credit_j);
    pending_m = hn::IfThenZeroElse(forgets, input.displacement_m);

    const Vector energy_j = hn::IfThenElse(held_force, observed_j,
                                           observed_j + input.wall_force_n * input.displacement_m);
    const Vector deficit_j = (zero - credit_j) - energy_j;
    const Flags acts =
        hn::And(hn::Gt(deficit_j, zero),
                hn::Gt(hn::Abs(input.velocity_m_per_s), load(parameters.law[2], first_lane)));
    const Vector max_damping = load(parameters.law[1], first_lane);
    const Flags capped = hn::Ge(deficit_j, max_damping * velocity_times_step);
    const Vector damping_n = hn::IfThenElse(capped, max_damping * input.velocity_m_per_s,
                                            deficit_j / input.displacement_m);
    return hn::IfThenElse(acts, input.wall_force_n + damping_n, input.wall_force_n);
  }
};

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_LAWS_INL_H_
