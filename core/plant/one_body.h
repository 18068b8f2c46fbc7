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
#include <optional>

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
  // A stretch of h seconds: u(θ), θ = t/h.
  struct Slide {
    TaylorPolynomial velocity;           // v, m/s
    TaylorPolynomial relative_velocity;  // u
    double duration_s = 0.0;
  };
  struct Stick {
    TaylorPolynomial net_force;  // F_h - F_d at rest, newtons
    double duration_s = 0.0;
  };

  OneBody(const OneBodyParameters& parameters, double period_s, double start_m);

  // Realtime-safe: yes, all that follows.
  void reset();
  [[nodiscard]] double position_m() const { return position_m_; }
  [[nodiscard]] double velocity_m_per_s() const { return velocity_m_per_s_; }
  [[nodiscard]] double kinetic_j() const {
    return 0.5 * parameters_.mass_kg * velocity_m_per_s_ * velocity_m_per_s_;
  }
  [[nodiscard]] double damping_n_s_per_m() const { return parameters_.damping_n_s_per_m; }
  [[nodiscard]] double hand_force_n(const HandDrive& drive) const {
    return parameters_.hand_stiffness_n_per_m * (drive.position_m - position_m_) +
           parameters_.hand_damping_n_s_per_m * (drive.velocity_m_per_s - velocity_m_per_s_);
  }

  // A whole tick under a constant load, by the scene's matrix.
  [[nodiscard]] MotionIncrement advance_tick(double load_n, const HandDrive& drive);

  // True only if v keeps its sign (that of `direction`, ±1) over a whole tick; false may be a
  // doubt.
  [[nodiscard]] bool surely_keeps_direction(double load_n, const HandDrive& drive,
                                            double direction) const;

  // Parts of a tick, for friction and bends of the path. Durations at most longest_stretch_s().
  [[nodiscard]] double longest_stretch_s() const { return longest_stretch_s_; }
  [[nodiscard]] Slide slide(double load_n, const HandDrive& drive, double duration_s,
                            double minimum_acceleration_sign) const;
  [[nodiscard]] MotionIncrement advance(const Slide& slide, const HandDrive& drive, double theta);
  [[nodiscard]] Stick stick(double force_n, const HandDrive& drive, double duration_s) const;
  void advance(const Stick& /*stick*/, double /*theta*/) {}
  void stop() { velocity_m_per_s_ = 0.0; }

 private:
  [[nodiscard]] double acceleration(double load_n, const HandDrive& drive) const {
    return (hand_force_n(drive) - load_n - parameters_.damping_n_s_per_m * velocity_m_per_s_) /
           parameters_.mass_kg;
  }
  // ∫F_h v dt from ∫u, ∫∫u, ∫u²: F_h = k_h e - b_h u with e = p - x, e' = -u, v = u + s.
  [[nodiscard]] double hand_work(const HandDrive& drive, double duration_s, double integral_u,
                                 double double_integral_u, double integral_u_squared) const;

  // Rows of the scene's matrix: what u and a at the start of a tick become.
  struct Rows {
    double velocity[2];         // v(T) - v(0)
    double integral[2];         // ∫u
    double double_integral[2];  // ∫∫u
    double square[3];           // ∫u² = square · (u², ua, a²)
  };

  OneBodyParameters parameters_;
  double period_s_;
  double start_m_;
  Rows rows_{};
  double longest_stretch_s_ = 0.0;
  double natural_rate_per_s_ = 0.0;  // sqrt(k_h/m)
  double damping_rate_per_s_ = 0.0;  // (b + b_h)/m
  double jerk_bound_ = 0.0;

  double position_m_ = 0.0;
  double velocity_m_per_s_ = 0.0;
};

// ---- the tick itself, inline: it is the inner loop ----

inline double OneBody::hand_work(const HandDrive& drive, double duration_s, double integral_u,
                                 double double_integral_u, double integral_u_squared) const {
  const double stretch_m = drive.position_m - position_m_;  // at the start
  const double speed = drive.velocity_m_per_s;
  return parameters_.hand_stiffness_n_per_m *
             (integral_u * (stretch_m - 0.5 * integral_u) +
              speed * (stretch_m * duration_s - double_integral_u)) -
         parameters_.hand_damping_n_s_per_m * (integral_u_squared + speed * integral_u);
}

inline MotionIncrement OneBody::advance_tick(double load_n, const HandDrive& drive) {
  const double a = acceleration(load_n, drive);
  const double s = drive.velocity_m_per_s;
  const double u = velocity_m_per_s_ - s;
  const double integral_u = rows_.integral[0] * u + rows_.integral[1] * a;
  const double double_integral_u = rows_.double_integral[0] * u + rows_.double_integral[1] * a;
  const double u_squared =
      rows_.square[0] * u * u + rows_.square[1] * u * a + rows_.square[2] * a * a;
  const double drift_m = s * period_s_;
  MotionIncrement increment;
  increment.displacement_m = drift_m + integral_u;
  increment.velocity_squared = s * (drift_m + 2.0 * integral_u) + u_squared;
  increment.hand_work_j = hand_work(drive, period_s_, integral_u, double_integral_u, u_squared);
  position_m_ += increment.displacement_m;
  velocity_m_per_s_ += rows_.velocity[0] * u + rows_.velocity[1] * a;
  return increment;
}

inline bool OneBody::surely_keeps_direction(double load_n, const HandDrive& drive,
                                            double direction) const {
  const double a = acceleration(load_n, drive);
  const double u = velocity_m_per_s_ - drive.velocity_m_per_s;
  // |v(t) - v(0) - a t| ≤ ½T² max|a'|, and |a'| stays below jerk_bound · max(|u|, |a|/rate).
  const double bound = jerk_bound_ * std::max(std::abs(u) * natural_rate_per_s_, std::abs(a));
  return direction * velocity_m_per_s_ + std::min(0.0, direction * a * period_s_) > bound;
}

}  // namespace hapticwall
