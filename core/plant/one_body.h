// The handle alone, or with a massless hand, or with a hand's mass joined rigidly to it:
//
//   m dv/dt = F_h - F_a - f - b v,   F_h = k_h (p - x) + b_h (p' - v),
//
// F_a the actuator's force, f the friction of the present direction, and the intended path p moving
// at a constant speed s. Without an amplifier's lag F_a is the force F that it is told to give;
// with one, e = F_a - F and de/dt = -e/τ. With u = v - s and a = dv/dt the motion is homogeneous,
// u'' = -(k_h/m) u - ((b + b_h)/m) u' + e/(τ m), so that x enters only through the balance of
// forces at the start and all cancellation happens there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/plant/amplifier_lag.h"
#include "core/plant/energy_totals.h"
#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

struct OneBodyParameters {
  double mass_kg = 1.0;
  double damping_n_s_per_m = 0.0;       // b
  double hand_stiffness_n_per_m = 0.0;  // k_h
  double hand_damping_n_s_per_m = 0.0;  // b_h
  double time_constant_s = 0.0;         // τ of the amplifier; not read without a lag
};

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
  // A piece of h seconds: u(θ), θ = t/h.
  struct Slide {
    TaylorPolynomial<Real> velocity;           // v, m/s
    TaylorPolynomial<Real> relative_velocity;  // u
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };
  struct Stick {
    TaylorPolynomial<Real> net_force;  // F_h - F_a at rest, newtons
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };

  // Rows of the scene's matrix for a step: what u, the net force f = m a and (with a lag) e at its
  // start become.
  static constexpr std::size_t kStates = kLag ? 3 : 2;
  using Row = std::array<Real, kStates>;
  struct Rows {
    Real duration_s = 0;
    Row velocity{};                                        // change of v
    Row integral{};                                        // ∫u
    Row double_integral{};                                 // ∫∫u
    std::array<Real, kStates*(kStates + 1) / 2> square{};  // ∫u² of (uu, uf, ff, ue, fe, ee)
    LagRows<Real, kLag, kStates> lag;
  };

  BasicOneBody(const OneBodyParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) {
    State state;
    state.position_m = position_m;
    return state;
  }
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
  // True only if v keeps its sign (that of `direction`, ±1) over the whole step; false may be a
  // doubt.
  [[nodiscard]] bool surely_slides(const Rows& rows, const State& state, const Load<Real>& load,
                                   const BasicHandDrive<Real>& drive, Real direction) const;
  // True only if a handle at rest stays so over the level's step; false may be a doubt.
  [[nodiscard]] bool surely_sticks(int level, const State& state, Real force_n,
                                   const BasicHandDrive<Real>& drive, Real friction_n) const;
  void advance_stick_level(int level, State& state, Real force_n,
                           const BasicHandDrive<Real>& /*drive*/) const {
    if constexpr (kLag) this->level(level).lag.settle(state, force_n);
  }

  // What is shorter than the deepest level. A handle that has just broken loose is not accelerated
  // against `push`, the sign of its direction (0: it moves already).
  [[nodiscard]] Slide slide(const State& state, const Load<Real>& load,
                            const BasicHandDrive<Real>& drive, Real duration_s, Real push) const;
  [[nodiscard]] MotionIncrement<Real> advance(State& state, const Slide& slide,
                                              const BasicHandDrive<Real>& drive, Real theta) const;
  [[nodiscard]] Stick stick(const State& state, Real force_n, const BasicHandDrive<Real>& drive,
                            Real duration_s) const;
  static void advance(State& state, const Stick& stick, Real theta) {
    if constexpr (kLag) stick.lag.settle(state, theta);
  }

 private:
  // The load last: it is what arrives last in a tick.
  [[nodiscard]] Real net_force_n(const State& state, const Load<Real>& load,
                                 const BasicHandDrive<Real>& drive) const {
    const Real net_n =
        (hand_force_n(state, drive) - damping_n_s_per_m_ * state.velocity_m_per_s) - load.total_n;
    if constexpr (kLag) return net_n - state.excess_n(load.force_n);
    return net_n;
  }
  // ∫F_h v dt from ∫u, ∫∫u, ∫u²: F_h = k_h e - b_h u with e = p - x, e' = -u, v = u + s.
  // `stretch_m`: p - x at the start.
  [[nodiscard]] Real hand_work(Real stretch_m, Real speed_m_per_s, Real duration_s, Real integral_u,
                               Real double_integral_u, Real integral_u_squared) const;

  Real damping_n_s_per_m_;
  Real hand_stiffness_n_per_m_;
  Real hand_damping_n_s_per_m_;
  Real half_mass_kg_;
  Real per_mass_;
  Real natural_rate_per_s_;  // sqrt(k_h/m)
  Real damping_rate_per_s_;  // (b + b_h)/m
  AmplifierLag<Real, kLag> lag_;
  std::vector<Rows> levels_;
};

using OneBody = BasicOneBody<double, false>;

// ---- the step itself, inline: it is the inner loop ----

template <typename Real, bool kLag>
[[gnu::always_inline]] inline Real BasicOneBody<Real, kLag>::hand_work(
    Real stretch_m, Real speed_m_per_s, Real duration_s, Real integral_u, Real double_integral_u,
    Real integral_u_squared) const {
  Real spring = integral_u * (stretch_m - integral_u / 2);
  Real damper = integral_u_squared;
  if (speed_m_per_s != 0) {
    spring += speed_m_per_s * (stretch_m * duration_s - double_integral_u);
    damper += speed_m_per_s * integral_u;
  }
  return hand_stiffness_n_per_m_ * spring - hand_damping_n_s_per_m_ * damper;
}

template <typename Real, bool kLag>
[[gnu::always_inline]] inline MotionIncrement<Real> BasicOneBody<Real, kLag>::advance_by(
    const Rows& rows, State& state, const Load<Real>& load,
    const BasicHandDrive<Real>& drive) const {
  const Real f = net_force_n(state, load, drive);
  const Real s = drive.velocity_m_per_s;
  const Real u = state.velocity_m_per_s - s;
  Real integral_u = rows.integral[0] * u + rows.integral[1] * f;
  Real u_squared = u * (rows.square[0] * u + rows.square[1] * f) + rows.square[2] * (f * f);
  Real velocity_m_per_s = (state.velocity_m_per_s + rows.velocity[0] * u) + rows.velocity[1] * f;
  Real excess_n = 0;
  if constexpr (kLag) {
    excess_n = state.excess_n(load.force_n);
    integral_u += rows.integral[2] * excess_n;
    u_squared += excess_n * (rows.square[3] * u + rows.square[4] * f + rows.square[5] * excess_n);
    velocity_m_per_s += rows.velocity[2] * excess_n;
  }
  MotionIncrement<Real> increment{integral_u, u_squared, 0, 0};
  Real double_integral_u = 0;
  if (s != 0) {  // most of the time a hand holds still
    const Real drift_m = s * rows.duration_s;
    double_integral_u = rows.double_integral[0] * u + rows.double_integral[1] * f;
    if constexpr (kLag) double_integral_u += rows.double_integral[2] * excess_n;
    increment.displacement_m = drift_m + integral_u;
    increment.velocity_squared = s * (drift_m + 2 * integral_u) + u_squared;
  }
  increment.hand_work_j = hand_work(drive.position_m - state.position_m, s, rows.duration_s,
                                    integral_u, double_integral_u, u_squared);
  if constexpr (kLag) {
    increment.lag_work_j = rows.lag.work(excess_n, s, {u, f, excess_n});
    rows.lag.settle(state, load.force_n);
  }
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = velocity_m_per_s;
  return increment;
}

// With w = sqrt(a² + ω²u²): ½m w² is the energy of a damped oscillator, which a lag's e feeds with
// at most |a e|/τ, so that w grows by at most ∫|e|/(τ m) dt. |v(t) - v(0)| ≤ t w, and |v(t) - v(0)
// - a t| ≤ ½t² |a'| with |a'| = |ω²u + c a - e/(τ m)| ≤ (ω + c) w + |e|/(τ m).
template <typename Real, bool kLag>
[[gnu::always_inline]] inline bool BasicOneBody<Real, kLag>::surely_slides(
    const Rows& rows, const State& state, const Load<Real>& load, const BasicHandDrive<Real>& drive,
    Real direction) const {
  const Real a = net_force_n(state, load, drive) * per_mass_;
  const Real u = (state.velocity_m_per_s - drive.velocity_m_per_s) * natural_rate_per_s_;
  Real w = std::sqrt(a * a + u * u);
  Real jerk = 0;
  const Real h = rows.duration_s;
  if constexpr (kLag) {
    const Real excess = std::abs(state.excess_n(load.force_n)) * per_mass_;
    w += rows.lag.settled_fraction * excess;
    jerk = lag_.rate_per_s * excess;
  }
  const Real v = direction * state.velocity_m_per_s;
  const Real bend = h * h / 2 * ((natural_rate_per_s_ + damping_rate_per_s_) * w + jerk);
  return v > h * w || v + std::min(Real(0), direction * a * h) > bend;
}

}  // namespace hapticwall
