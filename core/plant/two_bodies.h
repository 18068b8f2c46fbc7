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
#include <vector>

#include "core/plant/energy_totals.h"
#include "core/plant/propagator.h"
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
                                             const HandDrive& drive) const {
    return advance_by(levels_.front(), state, load_n, drive);
  }
  [[nodiscard]] bool surely_keeps_direction(const State& state, double load_n,
                                            const HandDrive& drive, double direction) const {
    return surely_slides(levels_.front(), state, load_n, drive, direction);
  }
  [[nodiscard]] int deepest_level() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] MotionIncrement advance_level(int level, State& state, double load_n,
                                              const HandDrive& drive) const {
    return advance_by(levels_[static_cast<std::size_t>(level)], state, load_n, drive);
  }
  [[nodiscard]] bool surely_slides(int level, const State& state, double load_n,
                                   const HandDrive& drive, double direction) const {
    return surely_slides(levels_[static_cast<std::size_t>(level)], state, load_n, drive, direction);
  }
  [[nodiscard]] bool surely_sticks(int level, const State& state, double force_n,
                                   const HandDrive& drive, double friction_n) const;
  void advance_stick_level(int level, State& state, const HandDrive& drive) const;
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

  struct Rows {
    double duration_s = 0.0;
    Row velocity{};                    // v(T) - v(0)
    Row hand_velocity{};               // w(T) - w(0)
    Row integral{};                    // ∫u1
    Row hand_integral{};               // ∫u2
    Row difference_double_integral{};  // ∫∫(u2 - u1)
    SymmetricForm square{};            // ∫u1²
    SymmetricForm grip_work{};         // ∫(k_g δ + b_g δ') u1, δ = ∫(u2 - u1)
  };

  // The hand alone while the handle sticks, relative to the speed w that it would settle at.
  struct StickRows {
    double velocity[2];  // change of w from (w - w_end, dw/dt)
    double integral[2];  // ∫(w - w_end)
  };

  [[nodiscard]] MotionIncrement advance_by(const Rows& rows, State& state, double load_n,
                                           const HandDrive& drive) const;
  [[nodiscard]] bool surely_slides(const Rows& rows, const State& state, double load_n,
                                   const HandDrive& drive, double direction) const;
  // The speed at which the hand's force on a handle at rest would stay constant.
  [[nodiscard]] double settling_velocity(const HandDrive& drive) const {
    const double total = parameters_.hand_stiffness_n_per_m + parameters_.grip_stiffness_n_per_m;
    return total > 0.0 ? parameters_.hand_stiffness_n_per_m / total * drive.velocity_m_per_s : 0.0;
  }
  void make_levels(int halvings);
  void make_stick_levels(int halvings);
  [[nodiscard]] Rows make_rows(const Propagator& propagator, double duration_s) const;

  TwoBodyParameters parameters_;
  double period_s_;
  double half_mass_kg_;
  double per_mass_;
  double per_hand_mass_;
  double jerk_per_root_energy_ = 0.0;
  std::vector<Rows> levels_;
  std::vector<StickRows> stick_levels_;
};

[[gnu::always_inline]] inline MotionIncrement TwoBodies::advance_by(const Rows& rows, State& state,
                                                                    double load_n,
                                                                    const HandDrive& drive) const {
  const Relative w = relative_state(state, load_n, drive);
  const double s = drive.velocity_m_per_s;
  const double drift_m = s * rows.duration_s;
  const double integral = dot(rows.integral, w);
  const double hand_integral = dot(rows.hand_integral, w);
  const double stretch_m = state.hand_position_m - state.position_m;  // at the start
  MotionIncrement increment;
  increment.displacement_m = drift_m + integral;
  increment.velocity_squared = s * (drift_m + 2.0 * integral) + form(rows.square, w);
  increment.hand_work_j =
      parameters_.grip_stiffness_n_per_m *
          (stretch_m * integral +
           s * (stretch_m * rows.duration_s + dot(rows.difference_double_integral, w))) +
      parameters_.grip_damping_n_s_per_m * s * (hand_integral - integral) + form(rows.grip_work, w);
  state.position_m += increment.displacement_m;
  state.hand_position_m += drift_m + hand_integral;
  state.velocity_m_per_s += dot(rows.velocity, w);
  state.hand_velocity_m_per_s += dot(rows.hand_velocity, w);
  return increment;
}

// The energy E = ½m a² + ½m_h a_h² + ½k_g (u_h - u)² + ½k_h u_h² of the relative motion never
// grows, so |a| ≤ sqrt(2E/m), and a' is bounded by a constant times sqrt(2E).
[[gnu::always_inline]] inline bool TwoBodies::surely_slides(const Rows& rows, const State& state,
                                                            double load_n, const HandDrive& drive,
                                                            double direction) const {
  const Relative w = relative_state(state, load_n, drive);
  const double grip = w[2] - w[0];
  const double root_energy =
      std::sqrt(parameters_.mass_kg * w[1] * w[1] + parameters_.hand_mass_kg * w[3] * w[3] +
                parameters_.grip_stiffness_n_per_m * grip * grip +
                parameters_.hand_stiffness_n_per_m * w[2] * w[2]);
  const double h = rows.duration_s;
  const double v = direction * state.velocity_m_per_s;
  const double bend = 0.5 * h * h * jerk_per_root_energy_ * root_energy;
  return v > h * root_energy * std::sqrt(per_mass_) ||
         v + std::min(0.0, direction * w[1] * h) > bend;
}

}  // namespace hapticwall
