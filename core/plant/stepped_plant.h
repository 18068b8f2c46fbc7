// The integrators that everyone else's simulator has: semi-implicit (symplectic) Euler and the
// classical Runge-Kutta method of fourth order, with a number of equal substeps in a tick. They are
// here so that a user can see what such a simulator would have shown; the exact integrator is the
// default.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/plant/energy_totals.h"
#include "core/plant/hand_path.h"
#include "core/sample.h"

namespace hapticwall {

struct SteppedParameters {
  double mass_kg = 1.0;
  double damping_n_s_per_m = 0.0;
  double friction_n = 0.0;
  double hand_mass_kg = 0.0;  // of a hand that grips; not read without one
  double hand_stiffness_n_per_m = 0.0;
  double hand_damping_n_s_per_m = 0.0;
  double grip_stiffness_n_per_m = 0.0;
  double grip_damping_n_s_per_m = 0.0;
};

// Handle and, where it grips, hand.
struct SteppedState {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double hand_position_m = 0.0;
  double hand_velocity_m_per_s = 0.0;
};

// The equations of motion. kGrip: the hand has a mass of its own.
template <bool kGrip>
struct SteppedMechanics {
  SteppedParameters p;

  [[nodiscard]] double hand_force_n(const SteppedState& y, const HandDrive& drive) const {
    if constexpr (kGrip) {
      return p.grip_stiffness_n_per_m * (y.hand_position_m - y.position_m) +
             p.grip_damping_n_s_per_m * (y.hand_velocity_m_per_s - y.velocity_m_per_s);
    } else {
      return p.hand_stiffness_n_per_m * (drive.position_m - y.position_m) +
             p.hand_damping_n_s_per_m * (drive.velocity_m_per_s - y.velocity_m_per_s);
    }
  }
  // Of the handle, less friction.
  [[nodiscard]] double net_force_n(const SteppedState& y, double force_n,
                                   const HandDrive& drive) const {
    return hand_force_n(y, drive) - force_n - p.damping_n_s_per_m * y.velocity_m_per_s;
  }
  [[nodiscard]] double hand_acceleration(const SteppedState& y, const HandDrive& drive) const {
    return (p.hand_stiffness_n_per_m * (drive.position_m - y.hand_position_m) +
            p.hand_damping_n_s_per_m * (drive.velocity_m_per_s - y.hand_velocity_m_per_s) -
            hand_force_n(y, drive)) /
           p.hand_mass_kg;
  }
};

// v += h a(x, v), then x += h v. Friction as an impulse that can stop the handle but not turn it.
// Energies are sums over substeps with the new velocity: as accurate as the method.
template <bool kGrip, bool kFriction>
struct SemiImplicitEuler {
  static void step(const SteppedMechanics<kGrip>& m, SteppedState& y, EnergyTotals& energy,
                   double force_n, const HandDrive& drive, double h) {
    const double hand_force_n = m.hand_force_n(y, drive);
    double hand_acceleration = 0.0;
    if constexpr (kGrip) hand_acceleration = m.hand_acceleration(y, drive);
    double v = y.velocity_m_per_s + h * m.net_force_n(y, force_n, drive) / m.p.mass_kg;
    if constexpr (kFriction) {
      const double stopping = h * m.p.friction_n / m.p.mass_kg;
      v = std::abs(v) <= stopping ? 0.0 : v - std::copysign(stopping, v);
    }
    const double dx = h * v;
    y.velocity_m_per_s = v;
    y.position_m += dx;
    if constexpr (kGrip) {
      y.hand_velocity_m_per_s += h * hand_acceleration;
      y.hand_position_m += h * y.hand_velocity_m_per_s;
    }
    energy.actuator_work_j += force_n * dx;
    energy.viscous_j += m.p.damping_n_s_per_m * v * dx;
    energy.friction_j += m.p.friction_n * std::abs(dx);
    energy.hand_work_j += hand_force_n * dx;
  }
};

// The classical method, with the energies as further components. The direction of friction is that
// of the substep's start; a handle that turns within a substep is stopped at its end.
template <bool kGrip, bool kFriction>
struct RungeKutta4 {
  struct Rate {
    double x, v, y, w, viscous, hand;
  };

  static Rate rate(const SteppedMechanics<kGrip>& m, const SteppedState& s, double force_n,
                   const HandDrive& drive, double direction) {
    const bool sticks = kFriction && direction == 0.0;
    const double v = sticks ? 0.0 : s.velocity_m_per_s;
    Rate r{v, 0.0, 0.0, 0.0, m.p.damping_n_s_per_m * v * v, m.hand_force_n(s, drive) * v};
    if (!sticks) {
      r.v = (m.net_force_n(s, force_n, drive) - direction * m.p.friction_n) / m.p.mass_kg;
    }
    if constexpr (kGrip) {
      r.y = s.hand_velocity_m_per_s;
      r.w = m.hand_acceleration(s, drive);
    }
    return r;
  }

  static SteppedState moved(const SteppedState& s, const Rate& r, double h) {
    return {s.position_m + h * r.x, s.velocity_m_per_s + h * r.v, s.hand_position_m + h * r.y,
            s.hand_velocity_m_per_s + h * r.w};
  }

  static double direction(const SteppedMechanics<kGrip>& m, const SteppedState& y, double force_n,
                          const HandDrive& drive) {
    if (!kFriction) return 0.0;
    if (y.velocity_m_per_s != 0.0) return std::copysign(1.0, y.velocity_m_per_s);
    const double net_n = m.net_force_n(y, force_n, drive);
    return std::abs(net_n) <= m.p.friction_n ? 0.0 : std::copysign(1.0, net_n);
  }

  static void step(const SteppedMechanics<kGrip>& m, SteppedState& y, EnergyTotals& energy,
                   double force_n, const HandDrive& drive, double h) {
    const double sign = direction(m, y, force_n, drive);
    const HandDrive middle{drive.position_m + 0.5 * h * drive.velocity_m_per_s,
                           drive.velocity_m_per_s};
    const HandDrive end{drive.position_m + h * drive.velocity_m_per_s, drive.velocity_m_per_s};
    const Rate a = rate(m, y, force_n, drive, sign);
    const Rate b = rate(m, moved(y, a, 0.5 * h), force_n, middle, sign);
    const Rate c = rate(m, moved(y, b, 0.5 * h), force_n, middle, sign);
    const Rate d = rate(m, moved(y, c, h), force_n, end, sign);
    const auto mean = [&](double Rate::*part) {
      return (a.*part + 2.0 * (b.*part) + 2.0 * (c.*part) + d.*part) / 6.0;
    };
    const Rate average{mean(&Rate::x), mean(&Rate::v),       mean(&Rate::y),
                       mean(&Rate::w), mean(&Rate::viscous), mean(&Rate::hand)};
    y = moved(y, average, h);
    if (kFriction && y.velocity_m_per_s * sign < 0.0) y.velocity_m_per_s = 0.0;
    energy.actuator_work_j += force_n * h * average.x;
    energy.viscous_j += h * average.viscous;
    energy.friction_j += m.p.friction_n * std::abs(h * average.x);
    energy.hand_work_j += h * average.hand;
  }
};

// A plant with the interface of ExactPlant. Realtime-safe: yes, after construction.
template <template <bool, bool> class Scheme, bool kGrip, bool kFriction>
class SteppedPlant {
 public:
  struct Motion {
    SteppedState body;
    EnergyTotals energy;
    StraightPath path;
  };

  SteppedPlant(const SteppedParameters& parameters, HandPath path, double period_s, double start_m,
               int substeps)
      : mechanics_{parameters},
        path_(std::move(path)),
        period_s_(period_s),
        start_m_(start_m),
        substeps_(substeps) {
    reset();
  }

  void reset() {
    motion_ = {};
    motion_.body = {start_m_, 0.0, start_m_, 0.0};
    path_.reset();
  }

  [[nodiscard]] HandPath& path() { return path_; }
  [[nodiscard]] double position_m() const { return motion_.body.position_m; }
  [[nodiscard]] const EnergyTotals& energy() const { return motion_.energy; }
  [[nodiscard]] double kinetic_j() const { return kinetic_j(motion_); }

  [[nodiscard]] Motion motion() const {
    Motion motion = motion_;
    motion.path = path_.straight();
    return motion;
  }
  void resume(const Motion& motion) {
    motion_ = motion;
    path_.resume(motion.path);
  }
  [[nodiscard]] double net_work_j(const Motion& motion) const {
    const double loss_j = kFriction ? motion.energy.dissipation_j() : motion.energy.viscous_j;
    return motion.energy.actuator_work_j + loss_j + kinetic_j(motion);
  }
  void write_truth(const Motion& motion, PlantTruth& truth) const {
    const HandDrive drive{motion.path.position_m, motion.path.velocity_m_per_s};
    truth.position_m = motion.body.position_m;
    truth.velocity_m_per_s = motion.body.velocity_m_per_s;
    truth.hand_path_m = motion.path.position_m;
    truth.hand_force_n = mechanics_.hand_force_n(motion.body, drive);
    truth.actuator_work_j = motion.energy.actuator_work_j;
    truth.dissipation_j = motion.energy.dissipation_j();
    truth.hand_work_j = motion.energy.hand_work_j;
    truth.kinetic_j = kinetic_j(motion);
  }

  [[nodiscard, gnu::always_inline]] bool try_tick(Motion& motion, double force_n) const {
    if (!motion.path.goes_on()) [[unlikely]] {
      return false;
    }
    pass(motion, force_n, {motion.path.position_m, motion.path.velocity_m_per_s}, period_s_);
    motion.path.next_tick();
    return true;
  }
  void advance(double force_n) {
    do {
      pass(motion_, force_n, {path_.position_m(), path_.velocity_m_per_s()},
           path_.piece_fraction() * period_s_);
    } while (path_.next_piece());
    path_.next_tick();
  }

 private:
  [[nodiscard]] double kinetic_j(const Motion& motion) const {
    const double v = motion.body.velocity_m_per_s;
    return 0.5 * mechanics_.p.mass_kg * (v * v);
  }
  [[gnu::always_inline]] void pass(Motion& motion, double force_n, HandDrive drive,
                                   double duration_s) const {
    const double h = duration_s / static_cast<double>(substeps_);
    const double begin_m = drive.position_m;
    for (int i = 0; i < substeps_; ++i) {
      drive.position_m = begin_m + drive.velocity_m_per_s * (h * static_cast<double>(i));
      Scheme<kGrip, kFriction>::step(mechanics_, motion.body, motion.energy, force_n, drive, h);
    }
  }

  SteppedMechanics<kGrip> mechanics_;
  HandPath path_;
  double period_s_;
  double start_m_;
  int substeps_;
  Motion motion_;  // its path is set anew from path_ where it is asked for
};

}  // namespace hapticwall
