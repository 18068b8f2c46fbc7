// The handle alone, or with a massless hand, or with a hand's mass joined rigidly to it:
//
//   m dv/dt = F_h - F_a - f - b v,   F_h = k_h (p - x) + b_h (p' - v),
//
// F_a the actuator's force, f the friction of the present direction, and the intended path p moving
// at a constant speed s. Without an amplifier's lag F_a is the command F; with one, e = F_a - F and
// de/dt = -e/τ. Core states (linear_motion.h) are u = v - s, the net force m a and e:
// m a' = -k_h u - (b + b_h) a + e/τ. The position x enters only through the balance of forces at
// the start, where all cancellation happens.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/plant/amplifier_lag.h"
#include "core/plant/energy_totals.h"
#include "core/plant/linear_motion.h"
#include "core/plant/plant_parameters.h"
#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

// Real: double, or long double for the reference.
template <typename Real, bool kLag>
class BasicOneBody {
 public:
  using Number = Real;
  static constexpr bool kHasLag = kLag;

  struct State : ActuatorState<Real, kLag> {
    Real position_m = 0;
    Real velocity_m_per_s = 0;
  };
  // A piece of h seconds, in θ = t/h.
  struct Slide {
    TaylorPolynomial<Real> velocity;    // v, m/s
    TaylorPolynomial<Real> hand_force;  // F_h, newtons
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };
  struct Stick {
    TaylorPolynomial<Real> net_force;  // F_h - F_a at rest, newtons
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };

  static constexpr std::size_t kStates = kLag ? 3 : 2;  // u, m a[, e]
  using Row = std::array<Real, kStates>;
  // Rows with those for a path at rest (u = v), which is the most frequent case and cheaper.
  struct Rows : LinearRows<Real, kLag, kStates> {
    Row integral_at_rest{};                         // ∫v
    SymmetricForm<Real, kStates> square_at_rest{};  // ∫v²
  };

  // Reads nothing of friction and grip.
  BasicOneBody(const PlantParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) {
    State state;
    state.position_m = position_m;
    return state;
  }
  // Moves the origin of the coordinates to `origin_m`; back with its negative.
  static void move_origin(State& state, Real origin_m) { state.position_m -= origin_m; }
  [[nodiscard]] Real kinetic_j(const State& state) const {
    return half_mass_kg_ * (state.velocity_m_per_s * state.velocity_m_per_s);
  }
  [[nodiscard]] Real damping_n_s_per_m() const { return damping_n_s_per_m_; }
  [[nodiscard]] Real hand_force_n(const State& state, const BasicHandDrive<Real>& drive) const {
    return hand_stiffness_n_per_m_ * (drive.position_m - state.position_m) +
           hand_damping_n_s_per_m_ * (drive.velocity_m_per_s - state.velocity_m_per_s);
  }

  // Level n lasts T/2^n; level 0 is the whole tick.
  [[nodiscard]] int deepest_level() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] const Rows& level(int n) const { return levels_[static_cast<std::size_t>(n)]; }

  // A whole step under a constant load, by the scene's matrix.
  [[nodiscard]] MotionIncrement<Real> advance_by(const Rows& rows, State& state,
                                                 const Load<Real>& load,
                                                 const BasicHandDrive<Real>& drive) const;
  // True guarantees that v keeps its sign (that of `direction`, ±1) over the whole step. False is
  // inconclusive.
  [[nodiscard]] bool surely_slides(const Rows& rows, const State& state, const Load<Real>& load,
                                   const BasicHandDrive<Real>& drive, Real direction) const;
  // True guarantees that a handle at rest stays so over the level's step. False is inconclusive.
  [[nodiscard]] bool surely_sticks(int level, const State& state, Real force_n,
                                   const BasicHandDrive<Real>& drive, Real friction_n) const;
  void advance_stick_level(int level, State& state, Real force_n,
                           const BasicHandDrive<Real>& /*drive*/) const {
    this->level(level).lag.settle(state, force_n);
  }

  // F_h - F_a on a handle at rest, newtons.
  [[nodiscard]] Real net_force_at_rest_n(const State& state, Real force_n,
                                         const BasicHandDrive<Real>& drive) const {
    const Real net_n = hand_force_n(state, drive) - force_n;
    if constexpr (kLag) return net_n - state.excess_n(force_n);
    return net_n;
  }
  // Motion for steps shorter than the deepest level. A handle that has just broken loose is not
  // accelerated against `push`, the sign of its direction (0: it already moves).
  [[nodiscard]] Slide slide(const State& state, const Load<Real>& load,
                            const BasicHandDrive<Real>& drive, Real duration_s, Real push) const;
  [[nodiscard]] MotionIncrement<Real> advance(State& state, const Slide& slide, Real theta) const;
  [[nodiscard]] Stick stick(const State& state, Real force_n, const BasicHandDrive<Real>& drive,
                            Real duration_s) const;
  static void advance(State& state, const Stick& stick, Real theta) {
    stick.lag.settle(state, theta);
  }

 private:
  // Adds the load last, because it arrives last in a tick.
  [[nodiscard]] Real net_force_n(const State& state, const Load<Real>& load,
                                 const BasicHandDrive<Real>& drive) const {
    const Real net_n =
        (hand_force_n(state, drive) - damping_n_s_per_m_ * state.velocity_m_per_s) - load.total_n;
    if constexpr (kLag) return net_n - state.excess_n(load.force_n);
    return net_n;
  }
  Real damping_n_s_per_m_;
  Real hand_stiffness_n_per_m_;
  Real hand_damping_n_s_per_m_;
  Real half_mass_kg_;
  Real per_mass_;
  Real natural_rate_per_s_;  // sqrt(k_h/m)
  Real damping_rate_per_s_;  // (b + b_h)/m
  Real fast_rate_per_s_;     // R if overdamped, else minus infinity
  AmplifierLag<Real, kLag> lag_;
  std::vector<Rows> levels_;
};

using OneBody = BasicOneBody<double, false>;

// ---- the step itself, inline: it is the inner loop ----

template <typename Real, bool kLag>
[[gnu::always_inline]] inline MotionIncrement<Real> BasicOneBody<Real, kLag>::advance_by(
    const Rows& rows, State& state, const Load<Real>& load,
    const BasicHandDrive<Real>& drive) const {
  const Real v = state.velocity_m_per_s;
  const Real s = drive.velocity_m_per_s;
  Row c{v - s, net_force_n(state, load, drive)};
  if constexpr (kLag) c[2] = state.excess_n(load.force_n);
  MotionIncrement<Real> increment;
  if (s == 0) {
    const Real dx = dot(rows.integral_at_rest, c);
    increment.displacement_m = dx;
    increment.velocity_squared = quadratic<Real, kStates>(rows.square_at_rest, c);
    increment.hand_work_j =
        hand_stiffness_n_per_m_ * (dx * ((drive.position_m - state.position_m) - dx / 2)) -
        hand_damping_n_s_per_m_ * increment.velocity_squared;
    if constexpr (kLag) increment.lag_work_j = rows.lag.work(v, c);
  } else {
    increment = rows.increment(v, hand_force_n(state, drive), c);
  }
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = v + dot(rows.velocity, c);
  rows.lag.settle(state, load.force_n);
  return increment;
}

// Let w = sqrt(a² + ω²u²). ½m w² is the energy of a damped oscillator, to which a lag adds a power
// of at most |a e|/τ, so w grows by at most ∫|e|/(τ m) dt. Each of four conditions is sufficient:
//   1. |v(t) - v(0)| ≤ t w.
//   2. |v(t) - v(0) - a t| ≤ ½t² |a'|, with |a'| ≤ (ω + c) w + |e|/(τ m) and c = (b + b_h)/m.
//   3. Creep: g = a + c v keeps its sign, because v' = g - c v and |g'| = |ω²u - e/(τ m)|.
//   4. Overdamped (rates r < R), and neither path nor excess pulls back: a + R v has the sign of v,
//      so v(t) ≥ (a + R v)(exp(-r t) - exp(-R t))/(R - r) at any time.
template <typename Real, bool kLag>
[[gnu::always_inline]] inline bool BasicOneBody<Real, kLag>::surely_slides(
    const Rows& rows, const State& state, const Load<Real>& load, const BasicHandDrive<Real>& drive,
    Real direction) const {
  const Real a = net_force_n(state, load, drive) * per_mass_;
  const Real u = (state.velocity_m_per_s - drive.velocity_m_per_s) * natural_rate_per_s_;
  Real w = std::sqrt(a * a + u * u);
  Real jerk = 0;
  Real settling = 0;
  const Real h = rows.duration_s;
  if constexpr (kLag) {
    const Real excess = std::abs(state.excess_n(load.force_n)) * per_mass_;
    settling = rows.lag.settled_fraction * excess;
    w += settling;
    jerk = lag_.rate_per_s * excess;
  }
  const Real v = direction * state.velocity_m_per_s;
  const Real bend = h * h / 2 * ((natural_rate_per_s_ + damping_rate_per_s_) * w + jerk);
  if (v > h * w || v + std::min(Real(0), direction * a * h) > bend) return true;
  if (!(v > 0)) return false;
  bool pulled_back = direction * drive.velocity_m_per_s < 0;
  if constexpr (kLag) pulled_back = pulled_back || direction * state.excess_n(load.force_n) < 0;
  return direction * a + damping_rate_per_s_ * v > h * natural_rate_per_s_ * w + settling ||
         (!pulled_back && direction * a + fast_rate_per_s_ * v > 0);
}

// On a handle at rest the hand's force changes linearly and a lag's excess decays, so the values at
// both ends bound the net force.
template <typename Real, bool kLag>
[[gnu::always_inline]] inline bool BasicOneBody<Real, kLag>::surely_sticks(
    int level, const State& state, Real force_n, const BasicHandDrive<Real>& drive,
    Real friction_n) const {
  const Rows& rows = this->level(level);
  const Real begin_n = hand_force_n(state, drive) - force_n;
  const Real end_n = begin_n + hand_stiffness_n_per_m_ * drive.velocity_m_per_s * rows.duration_s;
  Real most_n = std::max(begin_n, end_n);
  Real least_n = std::min(begin_n, end_n);
  if constexpr (kLag) {
    const Real excess_n = state.excess_n(force_n);
    const Real rest_n = excess_n - rows.lag.settled_fraction * excess_n;
    most_n -= std::min(excess_n, rest_n);
    least_n -= std::max(excess_n, rest_n);
  }
  return most_n <= friction_n && least_n >= -friction_n;
}

}  // namespace hapticwall
