// The handle alone, or with a massless hand, or with a hand's mass joined rigidly to it:
//
//   m dv/dt = F_h - L - b v,   F_h = k_h (p - x) + b_h (p' - v),
//
// L the load (actuator force plus the friction of the present direction), constant over the
// stretch, and the intended path p moving at a constant speed s. With u = v - s and a = dv/dt the
// motion is homogeneous, u'' = -(k_h/m) u - ((b + b_h)/m) u', so that x enters only through the
// balance of forces at the start and all cancellation happens there.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/plant/energy_totals.h"
#include "core/plant/taylor_polynomial.h"
#include "core/scene.h"

namespace hapticwall {

struct OneBodyParameters {
  double mass_kg = 1.0;
  double damping_n_s_per_m = 0.0;       // b
  double hand_stiffness_n_per_m = 0.0;  // k_h
  double hand_damping_n_s_per_m = 0.0;  // b_h
};

class OneBody {
 public:
  struct State {
    double position_m = 0.0;
    double velocity_m_per_s = 0.0;
  };
  // A piece of h seconds: u(θ), θ = t/h.
  struct Slide {
    TaylorPolynomial velocity;           // v, m/s
    TaylorPolynomial relative_velocity;  // u
    double duration_s = 0.0;
  };
  struct Stick {
    TaylorPolynomial net_force;  // F_h - F_d at rest, newtons
    double duration_s = 0.0;
  };

  OneBody(const OneBodyParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) { return {position_m, 0.0}; }
  [[nodiscard]] double kinetic_j(const State& state) const {
    return half_mass_kg_ * (state.velocity_m_per_s * state.velocity_m_per_s);
  }
  [[nodiscard]] double damping_n_s_per_m() const { return parameters_.damping_n_s_per_m; }
  [[nodiscard]] double hand_force_n(const State& state, const HandDrive& drive) const {
    return parameters_.hand_stiffness_n_per_m * (drive.position_m - state.position_m) +
           parameters_.hand_damping_n_s_per_m * (drive.velocity_m_per_s - state.velocity_m_per_s);
  }

  // A whole tick under a constant load, by the scene's matrix.
  [[nodiscard]] MotionIncrement advance_tick(State& state, double load_n,
                                             const HandDrive& drive) const {
    return advance_by(levels_.front(), state, load_n, drive);
  }

  // True only if v keeps its sign (that of `direction`, ±1) over the whole tick; false may be a
  // doubt.
  [[nodiscard]] bool surely_keeps_direction(const State& state, double load_n,
                                            const HandDrive& drive, double direction) const {
    return surely_slides(levels_.front(), state, load_n, drive, direction);
  }

  // Parts of a tick, for friction and bends of the path: level n lasts T/2^n.
  [[nodiscard]] int deepest_level() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] MotionIncrement advance_level(int level, State& state, double load_n,
                                              const HandDrive& drive) const {
    return advance_by(levels_[static_cast<std::size_t>(level)], state, load_n, drive);
  }
  [[nodiscard]] bool surely_slides(int level, const State& state, double load_n,
                                   const HandDrive& drive, double direction) const {
    return surely_slides(levels_[static_cast<std::size_t>(level)], state, load_n, drive, direction);
  }
  // True only if a handle at rest stays so over the level's step; false may be a doubt.
  [[nodiscard]] bool surely_sticks(int level, const State& state, double force_n,
                                   const HandDrive& drive, double friction_n) const;
  static void advance_stick_level(int /*level*/, State& /*state*/, const HandDrive& /*drive*/) {}

  // What is shorter than the deepest level.
  [[nodiscard]] Slide slide(const State& state, double load_n, const HandDrive& drive,
                            double duration_s, double minimum_acceleration_sign) const;
  [[nodiscard]] MotionIncrement advance(State& state, const Slide& slide, const HandDrive& drive,
                                        double theta) const;
  [[nodiscard]] Stick stick(const State& state, double force_n, const HandDrive& drive,
                            double duration_s) const;
  static void advance(State& /*state*/, const Stick& /*stick*/, double /*theta*/) {}

 private:
  // The load last: it is what arrives last in a tick.
  [[nodiscard]] double net_force_n(const State& state, double load_n,
                                   const HandDrive& drive) const {
    return (hand_force_n(state, drive) - parameters_.damping_n_s_per_m * state.velocity_m_per_s) -
           load_n;
  }
  // ∫F_h v dt from ∫u, ∫∫u, ∫u²: F_h = k_h e - b_h u with e = p - x, e' = -u, v = u + s.
  // `stretch_m`: p - x at the start.
  [[nodiscard]] double hand_work(double stretch_m, double speed_m_per_s, double duration_s,
                                 double integral_u, double double_integral_u,
                                 double integral_u_squared) const;

  // Rows of the scene's matrix: what u and the net force f = m a at the start of a tick become.
  struct Rows {
    double duration_s;
    double velocity[2];         // change of v
    double integral[2];         // ∫u
    double double_integral[2];  // ∫∫u
    double square[3];           // ∫u² = square · (u², uf, f²)
  };

  [[nodiscard]] MotionIncrement advance_by(const Rows& rows, State& state, double load_n,
                                           const HandDrive& drive) const;
  [[nodiscard]] bool surely_slides(const Rows& rows, const State& state, double load_n,
                                   const HandDrive& drive, double direction) const;

  OneBodyParameters parameters_;
  double half_mass_kg_;
  double per_mass_;
  double natural_rate_per_s_;  // sqrt(k_h/m)
  double damping_rate_per_s_;  // (b + b_h)/m
  std::vector<Rows> levels_;
};

// ---- the tick itself, inline: it is the inner loop ----

[[gnu::always_inline]] inline double OneBody::hand_work(double stretch_m, double speed_m_per_s,
                                                        double duration_s, double integral_u,
                                                        double double_integral_u,
                                                        double integral_u_squared) const {
  double spring = integral_u * (stretch_m - 0.5 * integral_u);
  double damper = integral_u_squared;
  if (speed_m_per_s != 0.0) {
    spring += speed_m_per_s * (stretch_m * duration_s - double_integral_u);
    damper += speed_m_per_s * integral_u;
  }
  return parameters_.hand_stiffness_n_per_m * spring - parameters_.hand_damping_n_s_per_m * damper;
}

[[gnu::always_inline]] inline MotionIncrement OneBody::advance_by(const Rows& rows, State& state,
                                                                  double load_n,
                                                                  const HandDrive& drive) const {
  const double f = net_force_n(state, load_n, drive);
  const double s = drive.velocity_m_per_s;
  const double u = state.velocity_m_per_s - s;
  const double integral_u = rows.integral[0] * u + rows.integral[1] * f;
  const double u_squared = u * (rows.square[0] * u + rows.square[1] * f) + rows.square[2] * (f * f);
  MotionIncrement increment{integral_u, u_squared, 0.0};
  double double_integral_u = 0.0;
  if (s != 0.0) {  // most of the time a hand holds still
    const double drift_m = s * rows.duration_s;
    double_integral_u = rows.double_integral[0] * u + rows.double_integral[1] * f;
    increment.displacement_m = drift_m + integral_u;
    increment.velocity_squared = s * (drift_m + 2.0 * integral_u) + u_squared;
  }
  increment.hand_work_j = hand_work(drive.position_m - state.position_m, s, rows.duration_s,
                                    integral_u, double_integral_u, u_squared);
  state.position_m += increment.displacement_m;
  state.velocity_m_per_s = (state.velocity_m_per_s + rows.velocity[0] * u) + rows.velocity[1] * f;
  return increment;
}

// With w = sqrt(a² + ω²u²), which never grows (½m w² is the energy of a damped oscillator):
// |v(t) - v(0)| ≤ t w and |v(t) - v(0) - a t| ≤ ½t² |a'| with |a'| = |ω²u + c a| ≤ (ω + c) w.
[[gnu::always_inline]] inline bool OneBody::surely_slides(const Rows& rows, const State& state,
                                                          double load_n, const HandDrive& drive,
                                                          double direction) const {
  const double a = net_force_n(state, load_n, drive) * per_mass_;
  const double u = (state.velocity_m_per_s - drive.velocity_m_per_s) * natural_rate_per_s_;
  const double w = std::sqrt(a * a + u * u);
  const double h = rows.duration_s;
  const double v = direction * state.velocity_m_per_s;
  const double bend = 0.5 * h * h * (natural_rate_per_s_ + damping_rate_per_s_) * w;
  return v > h * w || v + std::min(0.0, direction * a * h) > bend;
}

}  // namespace hapticwall
