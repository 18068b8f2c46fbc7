// The handle under linear forces: alone, with a massless hand, with a hand's mass joined rigidly to
// it, or (kGrip) held by a hand with a mass m_h of its own through the grip's spring-damper.
//
//   m dv/dt   = F_h - F_a - f - b v,                 F_h = k (y - x) + b_c (w - v)
//   m_h dw/dt = k_h (p - y) + b_h (p' - w) - F_h     with a grip; else y = p, w = p'
//
// x, v the handle's and y, w the hand's position and velocity; k, b_c of the grip or else of the
// hand; F_a the actuator's force, f the friction of the present direction. The intended path p
// moves at a constant speed s. Without an amplifier's lag F_a is the command F; with one (kLag) its
// excess e = F_a - F falls at the rate 1/τ.
//
// Core states c (linear_motion.h) are u, the hand's speed relative to the path (v - s without a
// grip), the net force m v' and e; with a grip also d = w - v and d'. Positions enter only through
// the balance of forces at the start, where all cancellation happens. A stiff grip holds d small,
// so these states stay small as well.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/plant/energy_totals.h"
#include "core/plant/linear_motion.h"
#include "core/plant/plant_parameters.h"
#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

// The state that a grip and an amplifier's lag add.
template <typename Real, bool kGrip>
struct GripState {};
template <typename Real>
struct GripState<Real, true> {
  Real hand_position_m = 0;
  Real hand_velocity_m_per_s = 0;
};
template <typename Real, bool kLag>
struct ActuatorState {};
template <typename Real>
struct ActuatorState<Real, true> {
  Real actuator_n = 0;  // F_a
};

// Real: double, or long double for the reference.
template <typename Real, bool kGrip, bool kLag>
class LinearBody {
 public:
  using Number = Real;
  using Drive = BasicHandDrive<Real>;
  static constexpr bool kHasLag = kLag;
  static constexpr std::size_t kStates = (kGrip ? 4 : 2) + (kLag ? 1 : 0);
  using Rows = LinearRows<Real, kStates>;
  using Row = typename Rows::Row;
  using Form = typename Rows::Form;

  struct State : ActuatorState<Real, kLag>, GripState<Real, kGrip> {
    Real position_m = 0;
    Real velocity_m_per_s = 0;
  };
  // A piece of h seconds, in θ = t/h. A handle at rest has the velocity 0.
  struct Piece {
    TaylorPolynomial<Real> velocity;    // v, m/s
    TaylorPolynomial<Real> hand_force;  // F_h, newtons
    TaylorPolynomial<Real> difference;  // d, m/s; 0 without a grip
    TaylorPolynomial<Real> excess;      // e, newtons; 0 without a lag
    Real force_n = 0;                   // F
    Real duration_s = 0;
  };

  // Reads nothing of friction. Realtime-safe: no.
  LinearBody(const PlantParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) {
    State state;
    move_origin(state, -static_cast<Real>(position_m));
    return state;
  }
  // To coordinates with the origin at `origin_m`; back with its negative.
  static void move_origin(State& state, Real origin_m) {
    state.position_m -= origin_m;
    if constexpr (kGrip) state.hand_position_m -= origin_m;
  }
  [[nodiscard]] Real kinetic_j(const State& state) const {
    return half_mass_kg_ * (state.velocity_m_per_s * state.velocity_m_per_s);
  }
  [[nodiscard]] Real damping_n_s_per_m() const { return damping_n_s_per_m_; }
  // F_h.
  [[nodiscard]] Real hand_force_n(const State& state, const Drive& drive) const {
    return stiffness_n_per_m_ * (holder_m(state, drive) - state.position_m) +
           coupling_n_s_per_m_ * (holder_m_per_s(state, drive) - state.velocity_m_per_s);
  }

  // Level n lasts T/2^n; level 0 is the whole tick.
  [[nodiscard]] int deepest_level() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] const Rows& level(int n) const { return levels_[static_cast<std::size_t>(n)]; }

  // A whole step under a constant load.
  [[nodiscard]] MotionIncrement<Real> advance_by(const Rows& rows, State& state,
                                                 const Load<Real>& load, const Drive& drive) const;
  // True guarantees that v keeps its sign (that of `direction`, ±1) over the whole step. False is
  // inconclusive.
  [[nodiscard]] bool surely_slides(const Rows& rows, const State& state, const Load<Real>& load,
                                   const Drive& drive, Real direction) const;
  // True guarantees that a handle at rest stays so over the step. False is inconclusive.
  [[nodiscard]] bool surely_sticks(const Rows& rows, const State& state, Real force_n,
                                   const Drive& drive, Real friction_n) const;
  // A whole step of a handle at rest, whose velocity must be 0.
  void advance_sticking(const Rows& rows, State& state, Real force_n, const Drive& drive) const;

  // F_h - F_a on a handle at rest, newtons.
  [[nodiscard]] Real net_force_at_rest_n(const State& state, Real force_n,
                                         const Drive& drive) const {
    return (hand_force_n(state, drive) - force_n) - excess_n(state, force_n);
  }
  // For steps shorter than the deepest level. A handle that has just broken loose is not
  // accelerated against `push`, the sign of its direction (0: it already moves).
  [[nodiscard]] Piece slide(const State& state, const Load<Real>& load, const Drive& drive,
                            Real duration_s, Real push) const;
  // The motion of hand and amplifier while the handle rests.
  [[nodiscard]] Piece stick(const State& state, Real force_n, const Drive& drive,
                            Real duration_s) const;
  // From the start of a piece to `theta` in [0, 1]: moves `state`, and returns the displacement and
  // the energies of this part.
  [[nodiscard]] MotionIncrement<Real> advance(State& state, const Piece& slide, Real theta) const;
  // advance() for a piece of stick(): moves hand and amplifier only.
  static void settle(State& state, const Piece& stick, Real theta);

 private:
  // Order of the states: the net force arrives last in a tick.
  static constexpr std::size_t kHand = 0;                 // u
  static constexpr std::size_t kDifference = 1;           // d
  static constexpr std::size_t kNet = kGrip ? 2 : 1;      // m v'
  static constexpr std::size_t kRate = 3;                 // d'
  static constexpr std::size_t kExcess = kStates - 1;     // e
  static constexpr std::size_t kVelocity = kStates;       // output v - v(0)
  static constexpr std::size_t kHandForce = kStates + 1;  // output F_h - F_h(0)
  struct Setup;

  // The other end of the spring k: the gripping hand or the path.
  [[nodiscard]] static Real holder_m(const State& state, const Drive& drive) {
    if constexpr (kGrip) return state.hand_position_m;
    return drive.position_m;
  }
  [[nodiscard]] static Real holder_m_per_s(const State& state, const Drive& drive) {
    if constexpr (kGrip) return state.hand_velocity_m_per_s;
    return drive.velocity_m_per_s;
  }
  [[nodiscard]] static Real excess_n(const State& state, Real force_n) {
    if constexpr (kLag) return state.actuator_n - force_n;
    return 0;
  }
  [[nodiscard]] Real hand_acceleration(const State& state, const Drive& drive) const {
    if constexpr (!kGrip) return 0;
    return (hand_stiffness_n_per_m_ * (drive.position_m - holder_m(state, drive)) +
            hand_damping_n_s_per_m_ * (drive.velocity_m_per_s - holder_m_per_s(state, drive)) -
            hand_force_n(state, drive)) *
           per_hand_mass_;
  }
  // The holder's speed at which its force on a handle at rest stays constant.
  [[nodiscard]] Real settling_velocity(const Drive& drive) const {
    return path_share_ * drive.velocity_m_per_s;
  }
  [[nodiscard]] Row core_states(const State& state, const Load<Real>& load,
                                const Drive& drive) const;
  void settle_lag(const Rows& rows, State& state, Real force_n) const {
    if constexpr (kLag) {
      state.actuator_n -= rows.settled_fraction * excess_n(state, force_n);
    }
  }
  [[nodiscard]] Piece piece(Row c, Real per_mass, Real duration_s) const;

  Real damping_n_s_per_m_;   // b
  Real stiffness_n_per_m_;   // k
  Real coupling_n_s_per_m_;  // b_c
  Real hand_stiffness_n_per_m_;
  Real hand_damping_n_s_per_m_;
  Real hand_mass_kg_;
  Real half_mass_kg_;
  Real per_mass_;
  Real per_hand_mass_;  // 0 without a grip: a path is not deflected
  Real root_per_mass_;
  Real root_per_hand_mass_;
  Real stick_stiffness_n_per_m_;  // k + k_h of the hand alone, while the handle sticks
  Real root_stick_stiffness_;
  Real path_share_;                  // k_h/(k + k_h), 0 without stiffness; 1 without a grip
  Real jerk_per_root_energy_;        // bounds a' of surely_slides()
  Real drive_rate_per_root_energy_;  // bounds g'
  Real self_damping_rate_per_s_;     // (b + b_c)/m
  Real fast_rate_per_s_;             // R if overdamped and without a grip, else minus infinity
  Real lag_rate_per_s_;              // 1/τ, or 0
  std::vector<Rows> levels_;
};

// ---- the step itself, inline: it is the inner loop ----

template <typename Real, bool kGrip, bool kLag>
[[gnu::always_inline]] inline auto LinearBody<Real, kGrip, kLag>::core_states(
    const State& state, const Load<Real>& load, const Drive& drive) const -> Row {
  Row c{};
  Real net_n =
      (hand_force_n(state, drive) - damping_n_s_per_m_ * state.velocity_m_per_s) - load.total_n;
  if constexpr (kLag) {
    c[kExcess] = excess_n(state, load.force_n);
    net_n -= c[kExcess];
  }
  c[kNet] = net_n;
  if constexpr (kGrip) {
    c[kHand] = state.hand_velocity_m_per_s - drive.velocity_m_per_s;
    c[kDifference] = state.hand_velocity_m_per_s - state.velocity_m_per_s;
    c[kRate] = hand_acceleration(state, drive) - net_n * per_mass_;
  } else {
    c[kHand] = state.velocity_m_per_s - drive.velocity_m_per_s;
  }
  return c;
}

template <typename Real, bool kGrip, bool kLag>
[[gnu::always_inline]] inline MotionIncrement<Real> LinearBody<Real, kGrip, kLag>::advance_by(
    const Rows& rows, State& state, const Load<Real>& load, const Drive& drive) const {
  const Row c = core_states(state, load, drive);
  const Real v = state.velocity_m_per_s;
  MotionIncrement<Real> increment;
  if (!kGrip && drive.velocity_m_per_s == 0) {
    const Real dx = dot(rows.integral_at_rest, c);
    increment.displacement_m = dx;
    increment.velocity_squared = quadratic<Real, kStates>(rows.square_at_rest, c);
    increment.hand_work_j =
        stiffness_n_per_m_ * (dx * ((drive.position_m - state.position_m) - dx / 2)) -
        coupling_n_s_per_m_ * increment.velocity_squared;
  } else {
    increment = rows.increment(v, hand_force_n(state, drive), c);
  }
  if constexpr (kLag) {
    increment.lag_work_j = c[kExcess] * (v * rows.excess_integral_s + dot(rows.excess_work, c));
  }
  const Real velocity_change = dot(rows.velocity, c);
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = v + velocity_change;
  if constexpr (kGrip) {
    state.hand_position_m += increment.displacement_m + dot(rows.stretch, c);
    state.hand_velocity_m_per_s += velocity_change + dot(rows.difference, c);
  }
  settle_lag(rows, state, load.force_n);
  return increment;
}

// E = ½m a² + ½m_h (w')² + ½k d² + ½k_h u² is the energy of the relative motion (d = -u and w' = 0
// without a grip). Only a lag adds to it, a power of at most |a e|/τ, so sqrt(2E) grows by at most
// ∫|e|/(τ sqrt(m)) dt. Each of four conditions is sufficient:
//   1. |v(t) - v(0)| ≤ t |a|.
//   2. |v(t) - v(0) - a t| ≤ ½t² |a'|.
//   3. Creep: g = a + (b + b_c)/m v keeps its sign, because v' = g - (b + b_c)/m v and
//      m g' = k d + b_c w' + e/τ.
//   4. Overdamped without grip (rates r < R), and neither path nor excess pulls back: a + R v has
//      the sign of v, so v(t) ≥ (a + R v)(exp(-r t) - exp(-R t))/(R - r) at any time.
template <typename Real, bool kGrip, bool kLag>
[[gnu::always_inline]] inline bool LinearBody<Real, kGrip, kLag>::surely_slides(
    const Rows& rows, const State& state, const Load<Real>& load, const Drive& drive,
    Real direction) const {
  const Row c = core_states(state, load, drive);
  const Real a = c[kNet] * per_mass_;
  Real twice_energy = a * c[kNet];
  if constexpr (kGrip) {
    const Real hand_a = a + c[kRate];
    twice_energy += hand_mass_kg_ * hand_a * hand_a +
                    stiffness_n_per_m_ * c[kDifference] * c[kDifference] +
                    hand_stiffness_n_per_m_ * c[kHand] * c[kHand];
  } else {
    twice_energy += stiffness_n_per_m_ * c[kHand] * c[kHand];
  }
  Real root = std::sqrt(twice_energy);
  Real jerk = 0;
  Real settling = 0;
  if constexpr (kLag) {
    const Real excess = std::abs(c[kExcess]);
    settling = rows.settled_fraction * excess * per_mass_;
    root += rows.settled_fraction * excess * root_per_mass_;
    jerk = lag_rate_per_s_ * excess * per_mass_;
  }
  const Real h = rows.duration_s;
  const Real v = direction * state.velocity_m_per_s;
  const Real bend = h * h / 2 * (jerk_per_root_energy_ * root + jerk);
  if (v > h * root * root_per_mass_ || v + std::min(Real(0), direction * a * h) > bend) return true;
  if (!(v > 0)) return false;
  if (direction * a + self_damping_rate_per_s_ * v >
      h * drive_rate_per_root_energy_ * root + settling) {
    return true;
  }
  if constexpr (kGrip) return false;
  const bool pulled_back =
      direction * drive.velocity_m_per_s < 0 || direction * excess_n(state, load.force_n) < 0;
  return !pulled_back && direction * a + fast_rate_per_s_ * v > 0;
}

// The net force changes at the rate k w + b_c w'. The energy ½m_h w'² + ½(k_h + k)(w - w_end)² of a
// gripping hand never grows, which bounds both terms. A lag's excess decays to a known value.
template <typename Real, bool kGrip, bool kLag>
[[gnu::always_inline]] inline bool LinearBody<Real, kGrip, kLag>::surely_sticks(
    const Rows& rows, const State& state, Real force_n, const Drive& drive, Real friction_n) const {
  const Real h = rows.duration_s;
  const Real end = settling_velocity(drive);
  Real rate = stiffness_n_per_m_ * std::abs(end);
  if constexpr (kGrip) {
    const Real u = state.hand_velocity_m_per_s - end;
    const Real a = hand_acceleration(state, drive);
    const Real root_energy = std::sqrt(hand_mass_kg_ * a * a + stick_stiffness_n_per_m_ * u * u);
    const Real max_a = root_energy * root_per_hand_mass_;
    Real max_w = std::abs(state.hand_velocity_m_per_s) + h * max_a;
    if (stick_stiffness_n_per_m_ > 0) {
      max_w = std::min(max_w, std::abs(end) + root_energy / root_stick_stiffness_);
    }
    rate = stiffness_n_per_m_ * max_w + coupling_n_s_per_m_ * max_a;
  }
  Real change_n = h * rate;
  if constexpr (kLag) change_n += rows.settled_fraction * std::abs(excess_n(state, force_n));
  return std::abs(net_force_at_rest_n(state, force_n, drive)) + change_n <= friction_n;
}

template <typename Real, bool kGrip, bool kLag>
[[gnu::always_inline]] inline void LinearBody<Real, kGrip, kLag>::advance_sticking(
    const Rows& rows, State& state, Real force_n, const Drive& drive) const {
  if constexpr (kGrip) {
    const Real end = settling_velocity(drive);
    const Real u = state.hand_velocity_m_per_s - end;
    const Real a = hand_acceleration(state, drive);
    state.hand_position_m +=
        end * rows.duration_s + (rows.stick_stretch[0] * u + rows.stick_stretch[1] * a);
    state.hand_velocity_m_per_s += rows.stick_difference[0] * u + rows.stick_difference[1] * a;
  }
  settle_lag(rows, state, force_n);
}

}  // namespace hapticwall
