// The handle held by a hand that has a mass of its own, through the grip's spring-damper:
//
//   m   dv/dt   = F_g - L - b v,                                   F_g = k_g (y - x) + b_g (w - v)
//   m_h dw/dt   = k_h (p - y) + b_h (p' - w) - F_g
//
// x, v the handle's and y, w the hand's position and velocity, L the load. As in one_body.h the
// velocities relative to the intended path, u = (v - s, w - s), obey a homogeneous equation.
// The "hand force" F_h on the handle, whose work the ledger tells, is F_g.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

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
};

class TwoBodies {
 public:
  struct State {
    double position_m = 0.0;  // of the handle
    double velocity_m_per_s = 0.0;
    double hand_position_m = 0.0;
    double hand_velocity_m_per_s = 0.0;
  };
  struct Slide {
    TaylorPolynomial velocity;                // v
    TaylorPolynomial relative_velocity;       // v - s
    TaylorPolynomial hand_relative_velocity;  // w - s
    TaylorPolynomial velocity_difference;     // w - v
    double duration_s = 0.0;
  };
  struct Stick {
    TaylorPolynomial hand_velocity;  // w
    TaylorPolynomial net_force;      // F_g - F_d with the handle at rest, newtons
    double duration_s = 0.0;
  };

  TwoBodies(const TwoBodyParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) {
    return {position_m, 0.0, position_m, 0.0};
  }
  [[nodiscard]] double kinetic_j(const State& state) const {
    return half_mass_kg_ * (state.velocity_m_per_s * state.velocity_m_per_s);
  }
  [[nodiscard]] double damping_n_s_per_m() const { return parameters_.damping_n_s_per_m; }
  [[nodiscard]] double hand_force_n(const State& state, const HandDrive& /*drive*/) const {
    return grip_force(state);
  }

  // As in OneBody.
  [[nodiscard]] MotionIncrement advance_tick(State& state, double load_n,
                                             const HandDrive& drive) const;
  [[nodiscard]] bool surely_keeps_direction(const State& state, double load_n,
                                            const HandDrive& drive, double direction) const;
  [[nodiscard]] double longest_stretch_s() const { return longest_stretch_s_; }
  [[nodiscard]] Slide slide(const State& state, double load_n, const HandDrive& drive,
                            double duration_s, double minimum_acceleration_sign) const;
  [[nodiscard]] MotionIncrement advance(State& state, const Slide& slide, const HandDrive& drive,
                                        double theta) const;
  [[nodiscard]] Stick stick(const State& state, double force_n, const HandDrive& drive,
                            double duration_s) const;
  static void advance(State& state, const Stick& stick, double theta);

 private:
  // (u1, a1, u2, a2): velocities relative to the path and accelerations, of handle and hand.
  using Relative = std::array<double, 4>;
  using Row = std::array<double, 4>;
  // 11, 12, 13, 14, 22, 23, 24, 33, 34, 44; off-diagonals doubled.
  using SymmetricForm = std::array<double, 10>;

  [[nodiscard]] double grip_force(const State& state) const {
    return parameters_.grip_stiffness_n_per_m * (state.hand_position_m - state.position_m) +
           parameters_.grip_damping_n_s_per_m *
               (state.hand_velocity_m_per_s - state.velocity_m_per_s);
  }
  [[nodiscard]] double hand_acceleration(const State& state, const HandDrive& drive) const {
    return (parameters_.hand_stiffness_n_per_m * (drive.position_m - state.hand_position_m) +
            parameters_.hand_damping_n_s_per_m *
                (drive.velocity_m_per_s - state.hand_velocity_m_per_s) -
            grip_force(state)) *
           per_hand_mass_;
  }
  [[nodiscard]] Relative relative_state(const State& state, double load_n,
                                        const HandDrive& drive) const {
    const double net_n =
        (grip_force(state) - parameters_.damping_n_s_per_m * state.velocity_m_per_s) - load_n;
    return {state.velocity_m_per_s - drive.velocity_m_per_s, net_n * per_mass_,
            state.hand_velocity_m_per_s - drive.velocity_m_per_s, hand_acceleration(state, drive)};
  }
  [[nodiscard]] static double dot(const Row& row, const Relative& w) {
    return row[0] * w[0] + row[1] * w[1] + row[2] * w[2] + row[3] * w[3];
  }
  [[nodiscard]] static double form(const SymmetricForm& f, const Relative& w) {
    return w[0] * (f[0] * w[0] + f[1] * w[1] + f[2] * w[2] + f[3] * w[3]) +
           w[1] * (f[4] * w[1] + f[5] * w[2] + f[6] * w[3]) + w[2] * (f[7] * w[2] + f[8] * w[3]) +
           f[9] * w[3] * w[3];
  }
  void make_rows();

  struct Rows {
    Row velocity{};                    // v(T) - v(0)
    Row hand_velocity{};               // w(T) - w(0)
    Row integral{};                    // ∫u1
    Row hand_integral{};               // ∫u2
    Row difference_double_integral{};  // ∫∫(u2 - u1)
    SymmetricForm square{};            // ∫u1²
    SymmetricForm grip_work{};         // ∫(k_g δ + b_g δ') u1, δ = ∫(u2 - u1)
  };

  TwoBodyParameters parameters_;
  double period_s_;
  double half_mass_kg_;
  double per_mass_;
  double per_hand_mass_;
  Rows rows_;
  double longest_stretch_s_ = 0.0;
  double natural_rate_per_s_ = 0.0;
  double jerk_bound_ = 0.0;
};

[[gnu::always_inline]] inline MotionIncrement TwoBodies::advance_tick(
    State& state, double load_n, const HandDrive& drive) const {
  const Relative w = relative_state(state, load_n, drive);
  const double s = drive.velocity_m_per_s;
  const double drift_m = s * period_s_;
  const double integral = dot(rows_.integral, w);
  const double hand_integral = dot(rows_.hand_integral, w);
  const double stretch_m = state.hand_position_m - state.position_m;  // at the start
  MotionIncrement increment;
  increment.displacement_m = drift_m + integral;
  increment.velocity_squared = s * (drift_m + 2.0 * integral) + form(rows_.square, w);
  increment.hand_work_j =
      parameters_.grip_stiffness_n_per_m *
          (stretch_m * integral +
           s * (stretch_m * period_s_ + dot(rows_.difference_double_integral, w))) +
      parameters_.grip_damping_n_s_per_m * s * (hand_integral - integral) +
      form(rows_.grip_work, w);
  state.position_m += increment.displacement_m;
  state.hand_position_m += drift_m + hand_integral;
  state.velocity_m_per_s += dot(rows_.velocity, w);
  state.hand_velocity_m_per_s += dot(rows_.hand_velocity, w);
  return increment;
}

[[gnu::always_inline]] inline bool TwoBodies::surely_keeps_direction(const State& state,
                                                                     double load_n,
                                                                     const HandDrive& drive,
                                                                     double direction) const {
  const Relative w = relative_state(state, load_n, drive);
  const double bound =
      jerk_bound_ * std::max(std::max(std::abs(w[0]), std::abs(w[2])) * natural_rate_per_s_,
                             std::max(std::abs(w[1]), std::abs(w[3])));
  return direction * state.velocity_m_per_s + std::min(0.0, direction * w[1] * period_s_) > bound;
}

}  // namespace hapticwall
