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
    const LaneAccount& a = block.state.account;
    measured_m_ = load(a.measured_m, at_);
    force_n_ = load(a.force_n, at_);
    was_in_contact_ = hn::Ne(load(a.in_contact, at_), hn::Zero(kTag));
    contacts_ = load(a.contacts, at_);
    peak_force_n_ = load(a.peak_force_n, at_);
    maximum_m_ = load(block.state.account.maximum_m, at_);
    cv_j_ = load(a.cv_j, at_);
    hold_j_ = load(a.hold_j, at_);
    scv_j_ = load(a.scv_j, at_);
    budget_j_ = load(a.budget_j, at_);
    min_cv_j_ = load(a.min_cv_j, at_);
    min_scv_j_ = load(a.min_scv_j, at_);
    actuator_work_j_ = load(a.actuator_work_j, at_);
    viscous_j_ = load(a.viscous_j, at_);
    hand_work_j_ = load(a.hand_work_j, at_);
    margin_j_ = load(a.margin_j, at_);
    if constexpr (kTail) load_tail(block.state);
  }

  HWY_INLINE void store_to(LaneState& state) const {
    LaneAccount& a = state.account;
    store(measured_m_, a.measured_m, at_);
    store(force_n_, a.force_n, at_);
    store(one_where(was_in_contact_), a.in_contact, at_);
    store(contacts_, a.contacts, at_);
    store(peak_force_n_, a.peak_force_n, at_);
    store(maximum_m_, state.account.maximum_m, at_);
    store(cv_j_, a.cv_j, at_);
    store(hold_j_, a.hold_j, at_);
    store(scv_j_, a.scv_j, at_);
    store(budget_j_, a.budget_j, at_);
    store(min_cv_j_, a.min_cv_j, at_);
    store(min_scv_j_, a.min_scv_j, at_);
    store(actuator_work_j_, a.actuator_work_j, at_);
    store(viscous_j_, a.viscous_j, at_);
    store(hand_work_j_, a.hand_work_j, at_);
    store(margin_j_, a.margin_j, at_);
    if constexpr (kTail) store_tail(state);
  }

  // `row`: the tick's in the trace.
  HWY_INLINE void add(std::uint64_t tick, std::size_t row) {
    const Vector position_m = load(trace_.position_m[row], at_);
    const Vector measured_m = kEncoder ? load(trace_.measured_m[row], at_) : position_m;
    const Vector force_n = load(trace_.force_n[row], at_);
    const Vector penetration_m = measured_m - load(parameters_.wall_m, at_);
    const Flags in_contact = hn::Gt(penetration_m, hn::Zero(kTag));
    add_to_ledger(measured_m - measured_m_, force_n);
    contacts_ = contacts_ + one_where(hn::AndNot(was_in_contact_, in_contact));
    keep_maximum(maximum_m_, position_m);
    keep_maximum(peak_force_n_, hn::Abs(force_n));
    if constexpr (kTail) add_to_tail(position_m, penetration_m, force_n, in_contact);
    exchange(tick, row, position_m, force_n);
    was_in_contact_ = in_contact;
    measured_m_ = measured_m;
    force_n_ = force_n;
  }

 private:
  // core/loop/energy_ledger.h.
  HWY_INLINE void add_to_ledger(Vector displacement_m, Vector force_n) {
    cv_j_ = cv_j_ + force_n * displacement_m;
    hold_j_ = hold_j_ + (force_n_ - force_n) * displacement_m;
    scv_j_ = scv_j_ + force_n_ * displacement_m;
    budget_j_ =
        budget_j_ - load(parameters_.budget_n_per_m, at_) * (displacement_m * displacement_m);
    keep_minimum(min_cv_j_, cv_j_);
    keep_minimum(min_scv_j_, scv_j_);
  }

  // core/simulation/metrics.h, the last second. begin_tail() discards the sums of lanes that are
  // not there yet.
  HWY_INLINE void add_to_tail(Vector position_m, Vector penetration_m, Vector force_n,
                              Flags in_contact) {
    keep_minimum(minimum_m_, position_m);
    tail_ticks_ = tail_ticks_ + constant(1.0);
    const Vector difference_n = force_n - mean_n_;
    mean_n_ = mean_n_ + difference_n / tail_ticks_;
    square_n2_ = square_n2_ + difference_n * (force_n - mean_n_);
    contact_force_n_ = contact_force_n_ + hn::IfThenElseZero(in_contact, force_n);
    contact_penetration_m_ = contact_penetration_m_ + hn::IfThenElseZero(in_contact, penetration_m);
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
    actuator_work_j_ = actuator_work_j_ + force_n * displacement_m;
    viscous_j_ = viscous_j_ + load(parameters_.damping_n_s_per_m, at_) * v_squared;
    hand_work_j_ = hand_work_j_ + hand_work_j;
    const Vector end_velocity = load(trace_.velocity_m_per_s[row + 1], at_);
    const Vector kinetic_j = load(parameters_.half_mass_kg, at_) * (end_velocity * end_velocity);
    keep_minimum(margin_j_, (actuator_work_j_ + viscous_j_) + kinetic_j);
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

  HWY_INLINE void load_tail(const LaneState& state) {
    minimum_m_ = load(state.account.minimum_m, at_);
    tail_ticks_ = load(state.account.tail_ticks, at_);
    mean_n_ = load(state.account.tail_mean_n, at_);
    square_n2_ = load(state.account.tail_square_n2, at_);
    contact_force_n_ = load(state.account.tail_contact_force_n, at_);
    contact_penetration_m_ = load(state.account.tail_contact_penetration_m, at_);
  }
  HWY_INLINE void store_tail(LaneState& state) const {
    store(minimum_m_, state.account.minimum_m, at_);
    store(tail_ticks_, state.account.tail_ticks, at_);
    store(mean_n_, state.account.tail_mean_n, at_);
    store(square_n2_, state.account.tail_square_n2, at_);
    store(contact_force_n_, state.account.tail_contact_force_n, at_);
    store(contact_penetration_m_, state.account.tail_contact_penetration_m, at_);
  }

  const LaneParameters& parameters_;
  const LaneTrace& trace_;
  std::size_t at_;  // first lane of the vector
  Vector measured_m_, force_n_;
  Flags was_in_contact_;
  Vector contacts_, peak_force_n_;
  Vector cv_j_, hold_j_, scv_j_, budget_j_, min_cv_j_, min_scv_j_;
  Vector actuator_work_j_, viscous_j_, hand_work_j_, margin_j_;
  Vector minimum_m_, maximum_m_;
  Vector tail_ticks_, mean_n_, square_n2_, contact_force_n_, contact_penetration_m_;
};

}  // namespace hapticwall::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // HAPTICWALL_LANE_ACCOUNT_INL_H_
