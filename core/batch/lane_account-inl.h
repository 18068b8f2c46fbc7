// Ledger, energies and metrics of one vector of lanes, from the trace of its motion. The same sums
// in the same order as core/loop/energy_ledger.h, core/plant/exact_plant.h and
// core/simulation/metrics.h, so the bits are the same. Separate from the loop of the motion, which
// is bound by latency; each loop fits the registers better alone. Compiled once per instruction
// set.
#if defined(HAPTICWALL_LANE_ACCOUNT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HAPTICWALL_LANE_ACCOUNT_INL_H_
#undef HAPTICWALL_LANE_ACCOUNT_INL_H_
#else
#define HAPTICWALL_LANE_ACCOUNT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "core/batch/lane_block.h"
#include "core/batch/lane_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hapticwall::batch::HWY_NAMESPACE {

template <bool kEncoder, bool kMoving, bool kTail>
class Account {
 public:
  HWY_INLINE Account(const LaneBlock& block, std::size_t first_lane)
      : parameters_(block.parameters), trace_(block.trace), at_(first_lane) {
    const LaneAccount& account = block.state.account;
    sums_ = load_struct<LaneSums>(account.sums, at_);
    was_in_contact_ = hn::Ne(load(account.in_contact, at_), hn::Zero(kTag));
    if constexpr (kTail) tail_ = load_struct<LaneTail>(account.tail, at_);
  }

  HWY_INLINE void store_to(LaneState& state) const {
    store_struct<LaneSums>(sums_, state.account.sums, at_);
    store(one_where(was_in_contact_), state.account.in_contact, at_);
    if constexpr (kTail) store_struct<LaneTail>(tail_, state.account.tail, at_);
  }

  // `row`: the tick's in the trace.
  HWY_INLINE void add(std::uint64_t tick, std::size_t row) {
    const Vector position_m = load(trace_.position_m[row], at_);
    const Vector measured_m = kEncoder ? load(trace_.measured_m[row], at_) : position_m;
    const Vector force_n = load(trace_.force_n[row], at_);
    const Vector penetration_m = measured_m - load(parameters_.wall_m, at_);
    const Flags in_contact = hn::Gt(penetration_m, hn::Zero(kTag));
    add_to_ledger(measured_m - sums_.measured_m, force_n);
    sums_.contacts = sums_.contacts + one_where(hn::AndNot(was_in_contact_, in_contact));
    keep_maximum(sums_.maximum_m, position_m);
    keep_maximum(sums_.peak_force_n, hn::Abs(force_n));
    if constexpr (kTail) add_to_tail(position_m, penetration_m, force_n, in_contact);
    exchange(tick, row, position_m, force_n);
    was_in_contact_ = in_contact;
    sums_.measured_m = measured_m;
    sums_.force_n = force_n;
  }

 private:
  // core/loop/energy_ledger.h.
  HWY_INLINE void add_to_ledger(Vector displacement_m, Vector force_n) {
    sums_.cv_j = sums_.cv_j + force_n * displacement_m;
    sums_.hold_j = sums_.hold_j + (sums_.force_n - force_n) * displacement_m;
    sums_.scv_j = sums_.scv_j + sums_.force_n * displacement_m;
    sums_.budget_j =
        sums_.budget_j - load(parameters_.budget_n_per_m, at_) * (displacement_m * displacement_m);
    keep_minimum(sums_.min_cv_j, sums_.cv_j);
    keep_minimum(sums_.min_scv_j, sums_.scv_j);
  }

  // core/simulation/metrics.h, the last second. begin_tail() discards the sums of lanes that are
  // not there yet.
  HWY_INLINE void add_to_tail(Vector position_m, Vector penetration_m, Vector force_n,
                              Flags in_contact) {
    keep_minimum(tail_.minimum_m, position_m);
    tail_.ticks = tail_.ticks + constant(1.0);
    const Vector difference_n = force_n - tail_.mean_n;
    tail_.mean_n = tail_.mean_n + difference_n / tail_.ticks;
    tail_.square_n2 = tail_.square_n2 + difference_n * (force_n - tail_.mean_n);
    tail_.contact_force_n = tail_.contact_force_n + hn::IfThenElseZero(in_contact, force_n);
    tail_.contact_penetration_m =
        tail_.contact_penetration_m + hn::IfThenElseZero(in_contact, penetration_m);
  }

  // core/plant/one_body.h, advance_by(), and core/plant/exact_plant.h, account().
  HWY_INLINE void exchange(std::uint64_t tick, std::size_t row, Vector position_m, Vector force_n) {
    const Vector f = load(trace_.net_force_n[row], at_);
    const Vector displacement_m = load(trace_.displacement_m[row], at_);
    const Vector v = load(trace_.velocity_m_per_s[row], at_);
    const Vector stretch_m = path_position<kMoving>(parameters_, at_, tick) - position_m;
    Vector v_squared = quadratic(parameters_.square_at_rest, at_, v, f);
    Vector hand_work_j = work_at_rest(stretch_m, displacement_m, v_squared);
    if constexpr (kMoving) {
      const Vector s = load(parameters_.path_speed_m_per_s, at_);
      const Flags rests = hn::Eq(s, hn::Zero(kTag));
      const Vector u = v - s;
      v_squared = hn::IfThenElse(rests, v_squared, square_in_motion(v, u, f));
      hand_work_j =
          hn::IfThenElse(rests, hand_work_j, work_in_motion(stretch_m, displacement_m, v, u, f));
    }
    sums_.actuator_work_j = sums_.actuator_work_j + force_n * displacement_m;
    sums_.viscous_j = sums_.viscous_j + load(parameters_.damping_n_s_per_m, at_) * v_squared;
    sums_.hand_work_j = sums_.hand_work_j + hand_work_j;
    const Vector end_velocity = load(trace_.velocity_m_per_s[row + 1], at_);
    const Vector kinetic_j = load(parameters_.half_mass_kg, at_) * (end_velocity * end_velocity);
    keep_minimum(sums_.margin_j, (sums_.actuator_work_j + sums_.viscous_j) + kinetic_j);
  }

  [[nodiscard]] HWY_INLINE Vector work_at_rest(Vector stretch_m, Vector displacement_m,
                                               Vector v_squared) const {
    return load(parameters_.hand_stiffness_n_per_m, at_) *
               (displacement_m * (stretch_m - constant(0.5) * displacement_m)) -
           load(parameters_.hand_damping_n_s_per_m, at_) * v_squared;
  }
  [[nodiscard]] HWY_INLINE Vector square_in_motion(Vector v, Vector u, Vector f) const {
    const Vector steady_m = v * load(parameters_.duration_s, at_);
    return v * (steady_m + constant(2.0) * dot(parameters_.drift, at_, u, f)) +
           quadratic(parameters_.square, at_, u, f);
  }
  [[nodiscard]] HWY_INLINE Vector work_in_motion(Vector stretch_m, Vector displacement_m, Vector v,
                                                 Vector u, Vector f) const {
    const Vector hand_n = load(parameters_.hand_stiffness_n_per_m, at_) * stretch_m -
                          load(parameters_.hand_damping_n_s_per_m, at_) * u;
    return hand_n * displacement_m + (v * dot(parameters_.hand_force_drift, at_, u, f) +
                                      quadratic(parameters_.hand_work, at_, u, f));
  }

  const LaneParameters& parameters_;
  const LaneTrace& trace_;
  std::size_t at_;  // first lane of the vector
  LaneSums<Vector> sums_;
  LaneTail<Vector> tail_;
  Flags was_in_contact_;
};

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_ACCOUNT_INL_H_
