// The handle held by a hand that has a mass of its own, through the grip's spring-damper:
//
//   m   dv/dt   = F_g - F_a - f - b v,                             F_g = k_g (y - x) + b_g (w - v)
//   m_h dw/dt   = k_h (p - y) + b_h (p' - w) - F_g
//
// x, v the handle's and y, w the hand's position and velocity; the rest as in one_body.h. The
// velocities relative to the intended path, u = (v - s, w - s), obey a homogeneous equation.
// The "hand force" F_h on the handle, whose work the ledger tells, is F_g.
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

struct TwoBodyParameters {
  double mass_kg = 1.0;
  double damping_n_s_per_m = 0.0;
  double hand_mass_kg = 1.0;
  double hand_stiffness_n_per_m = 0.0;
  double hand_damping_n_s_per_m = 0.0;
  double grip_stiffness_n_per_m = 0.0;
  double grip_damping_n_s_per_m = 0.0;
  double time_constant_s = 0.0;  // τ of the amplifier; not read without a lag
};

// Members as in BasicOneBody.
template <typename Real, bool kLag>
class BasicTwoBodies {
 public:
  using Number = Real;
  static constexpr bool kHasLag = kLag;

  struct State : ActuatorState<Real, kLag> {
    Real position_m = 0;  // of the handle
    Real velocity_m_per_s = 0;
    Real hand_position_m = 0;
    Real hand_velocity_m_per_s = 0;
  };
  struct Slide {
    TaylorPolynomial<Real> velocity;                // v
    TaylorPolynomial<Real> relative_velocity;       // v - s
    TaylorPolynomial<Real> hand_relative_velocity;  // w - s
    TaylorPolynomial<Real> velocity_difference;     // w - v
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };
  struct Stick {
    TaylorPolynomial<Real> hand_velocity;  // w
    TaylorPolynomial<Real> net_force;      // F_g - F_a with the handle at rest, newtons
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };

  // (u1, a1, u2, a2[, e]): velocities relative to the path and accelerations, of handle and hand.
  static constexpr std::size_t kStates = kLag ? 5 : 4;
  using Row = std::array<Real, kStates>;
  // The upper triangle row by row: 11, 12, …, 22, …; off-diagonals doubled.
  using SymmetricForm = std::array<Real, kStates*(kStates + 1) / 2>;
  struct Rows {
    Real duration_s = 0;
    Row velocity{};                    // v(T) - v(0)
    Row hand_velocity{};               // w(T) - w(0)
    Row integral{};                    // ∫u1
    Row hand_integral{};               // ∫u2
    Row difference_double_integral{};  // ∫∫(u2 - u1)
    SymmetricForm square{};            // ∫u1²
    SymmetricForm grip_work{};         // ∫(k_g δ + b_g δ') u1, δ = ∫(u2 - u1)
    LagRows<Real, kLag, kStates> lag;
  };

  BasicTwoBodies(const TwoBodyParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) {
    State state;
    state.position_m = state.hand_position_m = position_m;
    return state;
  }
  [[nodiscard]] Real kinetic_j(const State& state) const {
    return half_mass_kg_ * (state.velocity_m_per_s * state.velocity_m_per_s);
  }
  [[nodiscard]] Real damping_n_s_per_m() const { return parameters_.damping_n_s_per_m; }
  [[nodiscard]] Real hand_force_n(const State& state, const BasicHandDrive<Real>& /*drive*/) const {
    return grip_force(state);
  }

  [[nodiscard]] int deepest_level() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] const Rows& level(int n) const { return levels_[static_cast<std::size_t>(n)]; }
  [[nodiscard]] MotionIncrement<Real> advance_by(const Rows& rows, State& state,
                                                 const Load<Real>& load,
                                                 const BasicHandDrive<Real>& drive) const;
  [[nodiscard]] bool surely_slides(const Rows& rows, const State& state, const Load<Real>& load,
                                   const BasicHandDrive<Real>& drive, Real direction) const;
  [[nodiscard]] bool surely_sticks(int level, const State& state, Real force_n,
                                   const BasicHandDrive<Real>& drive, Real friction_n) const;
  void advance_stick_level(int level, State& state, Real force_n,
                           const BasicHandDrive<Real>& drive) const;
  [[nodiscard]] Slide slide(const State& state, const Load<Real>& load,
                            const BasicHandDrive<Real>& drive, Real duration_s, Real push) const;
  [[nodiscard]] MotionIncrement<Real> advance(State& state, const Slide& slide,
                                              const BasicHandDrive<Real>& drive, Real theta) const;
  [[nodiscard]] Stick stick(const State& state, Real force_n, const BasicHandDrive<Real>& drive,
                            Real duration_s) const;
  static void advance(State& state, const Stick& stick, Real theta);

 private:
  [[nodiscard]] Real grip_force(const State& state) const {
    return parameters_.grip_stiffness_n_per_m * (state.hand_position_m - state.position_m) +
           parameters_.grip_damping_n_s_per_m *
               (state.hand_velocity_m_per_s - state.velocity_m_per_s);
  }
  [[nodiscard]] Real hand_acceleration(const State& state,
                                       const BasicHandDrive<Real>& drive) const {
    return (parameters_.hand_stiffness_n_per_m * (drive.position_m - state.hand_position_m) +
            parameters_.hand_damping_n_s_per_m *
                (drive.velocity_m_per_s - state.hand_velocity_m_per_s) -
            grip_force(state)) *
           per_hand_mass_;
  }
  [[nodiscard]] Row relative_state(const State& state, const Load<Real>& load,
                                   const BasicHandDrive<Real>& drive) const {
    Real net_n =
        (grip_force(state) - parameters_.damping_n_s_per_m * state.velocity_m_per_s) - load.total_n;
    Row row{state.velocity_m_per_s - drive.velocity_m_per_s, 0,
            state.hand_velocity_m_per_s - drive.velocity_m_per_s, hand_acceleration(state, drive)};
    if constexpr (kLag) {
      row[4] = state.excess_n(load.force_n);
      net_n -= row[4];
    }
    row[1] = net_n * per_mass_;
    return row;
  }
  [[nodiscard]] static Real dot(const Row& row, const Row& w) {
    Real sum = row[0] * w[0];
    for (std::size_t i = 1; i < kStates; ++i) sum += row[i] * w[i];
    return sum;
  }
  [[nodiscard]] static Real form(const SymmetricForm& f, const Row& w) {
    Real sum = 0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < kStates; ++i) {
      Real part = f[k++] * w[i];
      for (std::size_t j = i + 1; j < kStates; ++j) part += f[k++] * w[j];
      sum += w[i] * part;
    }
    return sum;
  }

  // The hand alone while the handle sticks, relative to the speed w that it would settle at.
  struct StickRows {
    std::array<Real, 2> velocity{};  // change of w from (w - w_end, dw/dt)
    std::array<Real, 2> integral{};  // ∫(w - w_end)
  };

  // The speed at which the hand's force on a handle at rest would stay constant.
  [[nodiscard]] Real settling_velocity(const BasicHandDrive<Real>& drive) const {
    const Real total = parameters_.hand_stiffness_n_per_m + parameters_.grip_stiffness_n_per_m;
    return total > 0 ? parameters_.hand_stiffness_n_per_m / total * drive.velocity_m_per_s : 0;
  }
  // sqrt(2E) of the relative motion's energy E; see surely_slides().
  [[nodiscard]] Real root_energy(const Row& w) const;
  void make_levels(const TwoBodyParameters& parameters, int halvings);
  void make_stick_levels(const TwoBodyParameters& parameters, int halvings);

  // The parameters as numbers of this plant.
  struct Parameters {
    Real mass_kg, damping_n_s_per_m, hand_mass_kg, hand_stiffness_n_per_m, hand_damping_n_s_per_m,
        grip_stiffness_n_per_m, grip_damping_n_s_per_m;
  };

  Parameters parameters_;
  AmplifierLag<Real, kLag> lag_;
  double period_s_;
  Real half_mass_kg_;
  Real per_mass_;
  Real per_hand_mass_;
  Real jerk_per_root_energy_ = 0;
  std::vector<Rows> levels_;
  std::vector<StickRows> stick_levels_;
};

using TwoBodies = BasicTwoBodies<double, false>;

template <typename Real, bool kLag>
[[gnu::always_inline]] inline MotionIncrement<Real> BasicTwoBodies<Real, kLag>::advance_by(
    const Rows& rows, State& state, const Load<Real>& load,
    const BasicHandDrive<Real>& drive) const {
  const Row w = relative_state(state, load, drive);
  const Real s = drive.velocity_m_per_s;
  const Real drift_m = s * rows.duration_s;
  const Real integral = dot(rows.integral, w);
  const Real hand_integral = dot(rows.hand_integral, w);
  const Real stretch_m = state.hand_position_m - state.position_m;  // at the start
  MotionIncrement<Real> increment;
  increment.displacement_m = drift_m + integral;
  increment.velocity_squared = s * (drift_m + 2 * integral) + form(rows.square, w);
  increment.hand_work_j =
      parameters_.grip_stiffness_n_per_m *
          (stretch_m * integral +
           s * (stretch_m * rows.duration_s + dot(rows.difference_double_integral, w))) +
      parameters_.grip_damping_n_s_per_m * s * (hand_integral - integral) + form(rows.grip_work, w);
  if constexpr (kLag) {
    increment.lag_work_j = rows.lag.work(w[4], s, w);
    rows.lag.settle(state, load.force_n);
  }
  state.position_m += increment.displacement_m;
  state.hand_position_m += drift_m + hand_integral;
  state.velocity_m_per_s += dot(rows.velocity, w);
  state.hand_velocity_m_per_s += dot(rows.hand_velocity, w);
  return increment;
}

template <typename Real, bool kLag>
[[gnu::always_inline]] inline Real BasicTwoBodies<Real, kLag>::root_energy(const Row& w) const {
  const Real grip = w[2] - w[0];
  return std::sqrt(parameters_.mass_kg * w[1] * w[1] + parameters_.hand_mass_kg * w[3] * w[3] +
                   parameters_.grip_stiffness_n_per_m * grip * grip +
                   parameters_.hand_stiffness_n_per_m * w[2] * w[2]);
}

// The energy E = ½m a² + ½m_h a_h² + ½k_g (u_h - u)² + ½k_h u_h² of the relative motion never grows
// but by a lag's |a e|/τ, so that sqrt(2E) grows by at most ∫|e|/(τ sqrt(m)) dt; |a| ≤ sqrt(2E/m),
// and a' is bounded by a constant times sqrt(2E), and |e|/(τ m).
template <typename Real, bool kLag>
[[gnu::always_inline]] inline bool BasicTwoBodies<Real, kLag>::surely_slides(
    const Rows& rows, const State& state, const Load<Real>& load, const BasicHandDrive<Real>& drive,
    Real direction) const {
  const Row w = relative_state(state, load, drive);
  Real root = root_energy(w);
  Real jerk = 0;
  if constexpr (kLag) {
    const Real excess_n = std::abs(w[4]);
    root += rows.lag.settled_fraction * excess_n * std::sqrt(per_mass_);
    jerk = lag_.rate_per_s * excess_n * per_mass_;
  }
  const Real h = rows.duration_s;
  const Real v = direction * state.velocity_m_per_s;
  const Real bend = h * h / 2 * (jerk_per_root_energy_ * root + jerk);
  return v > h * root * std::sqrt(per_mass_) || v + std::min(Real(0), direction * w[1] * h) > bend;
}

}  // namespace hapticwall
