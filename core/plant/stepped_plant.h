// The usual integrators of simulators: semi-implicit (symplectic) Euler and the classical
// Runge-Kutta method of fourth order, with a number of equal substeps in a tick. They reproduce the
// errors of such simulators; the exact integrator is the default. Only `accuracy` measures their
// speed, so they test for optional parts at run time.
#pragma once

#include <cmath>
#include <utility>

#include "core/plant/energy_totals.h"
#include "core/plant/moving_plant.h"
#include "core/plant/plant_parameters.h"

namespace hapticwall {

// Handle, hand and amplifier. Members of an absent part stay 0.
struct SteppedState {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double hand_position_m = 0.0;
  double hand_velocity_m_per_s = 0.0;
  double actuator_n = 0.0;
};

// The equations of motion.
struct SteppedMechanics {
  using State = SteppedState;
  PlantParameters p;

  [[nodiscard]] double hand_force_n(const State& y, const HandDrive& drive) const {
    if (p.grip) {
      return p.grip_stiffness_n_per_m * (y.hand_position_m - y.position_m) +
             p.grip_damping_n_s_per_m * (y.hand_velocity_m_per_s - y.velocity_m_per_s);
    }
    return p.hand_stiffness_n_per_m * (drive.position_m - y.position_m) +
           p.hand_damping_n_s_per_m * (drive.velocity_m_per_s - y.velocity_m_per_s);
  }
  // The actuator's real force under the command `force_n`.
  [[nodiscard]] double actuator_n(const State& y, double force_n) const {
    return p.has_lag() ? y.actuator_n : force_n;
  }
  // Net force on the handle, without friction.
  [[nodiscard]] double net_force_n(const State& y, double force_n, const HandDrive& drive) const {
    return hand_force_n(y, drive) - actuator_n(y, force_n) -
           p.damping_n_s_per_m * y.velocity_m_per_s;
  }
  [[nodiscard]] double hand_acceleration(const State& y, const HandDrive& drive) const {
    return (p.hand_stiffness_n_per_m * (drive.position_m - y.hand_position_m) +
            p.hand_damping_n_s_per_m * (drive.velocity_m_per_s - y.hand_velocity_m_per_s) -
            hand_force_n(y, drive)) /
           p.hand_mass_kg;
  }
};

// v += h a(x, v), then x += h v; an amplifier's force first. Friction is an impulse that can stop
// the handle but not reverse it, by the speed at the start of the substep. Energies are sums over
// substeps with the new velocity, as accurate as the method.
struct SemiImplicitEuler {
  static void step(const SteppedMechanics& m, SteppedState& y, EnergyTotals& energy, double force_n,
                   const HandDrive& drive, double h) {
    const double hand_force_n = m.hand_force_n(y, drive);
    double hand_acceleration = 0.0;
    if (m.p.grip) hand_acceleration = m.hand_acceleration(y, drive);
    if (m.p.has_lag()) y.actuator_n += h * (force_n - y.actuator_n) / m.p.time_constant_s;
    const double friction_n = m.p.friction_at_n(y.velocity_m_per_s);
    double v = y.velocity_m_per_s + h * m.net_force_n(y, force_n, drive) / m.p.mass_kg;
    if (m.p.has_friction()) {
      const double stopping = h * friction_n / m.p.mass_kg;
      v = std::abs(v) <= stopping ? 0.0 : v - std::copysign(stopping, v);
    }
    const double dx = h * v;
    y.velocity_m_per_s = v;
    y.position_m += dx;
    if (m.p.grip) {
      y.hand_velocity_m_per_s += h * hand_acceleration;
      y.hand_position_m += h * y.hand_velocity_m_per_s;
    }
    energy.actuator_work_j += m.actuator_n(y, force_n) * dx;
    energy.viscous_j += m.p.damping_n_s_per_m * v * dx;
    energy.friction_j += friction_n * std::abs(dx);
    energy.hand_work_j += hand_force_n * dx;
  }
};

// The classical method, with the energies as further components. Friction keeps the direction of
// the start of the substep; a handle that reverses within a substep is stopped at its end.
struct RungeKutta4 {
  using State = SteppedState;

  // Rates of x, v (handle), y, w (hand) and the actuator's force, then four powers in watts.
  struct Rate {
    double x, v, y, w, actuator, work, viscous, hand, friction;
  };

  // Rates in the state `s`. With friction a direction() of 0 holds the handle.
  static Rate rate(const SteppedMechanics& m, const State& s, double force_n,
                   const HandDrive& drive, double direction) {
    const bool sticks = m.p.has_friction() && direction == 0.0;
    const double v = sticks ? 0.0 : s.velocity_m_per_s;
    Rate r{};
    r.x = v;
    r.work = m.actuator_n(s, force_n) * v;
    r.viscous = m.p.damping_n_s_per_m * v * v;
    r.hand = m.hand_force_n(s, drive) * v;
    if (!sticks) {
      const double friction_n = direction * m.p.friction_at_n(v);
      r.v = (m.net_force_n(s, force_n, drive) - friction_n) / m.p.mass_kg;
      r.friction = friction_n * v;
    }
    if (m.p.grip) {
      r.y = s.hand_velocity_m_per_s;
      r.w = m.hand_acceleration(s, drive);
    }
    if (m.p.has_lag()) r.actuator = (force_n - s.actuator_n) / m.p.time_constant_s;
    return r;
  }

  static State moved(const SteppedMechanics& m, const State& s, const Rate& r, double h) {
    State next = s;
    next.position_m += h * r.x;
    next.velocity_m_per_s += h * r.v;
    if (m.p.grip) {
      next.hand_position_m += h * r.y;
      next.hand_velocity_m_per_s += h * r.w;
    }
    if (m.p.has_lag()) next.actuator_n += h * r.actuator;
    return next;
  }

  // Sign of the sliding; 0 without friction, and at rest with a net force within friction.
  static double direction(const SteppedMechanics& m, const State& y, double force_n,
                          const HandDrive& drive) {
    if (!m.p.has_friction()) return 0.0;
    if (y.velocity_m_per_s != 0.0) return std::copysign(1.0, y.velocity_m_per_s);
    const double net_n = m.net_force_n(y, force_n, drive);
    return std::abs(net_n) <= m.p.friction_at_n(0.0) ? 0.0 : std::copysign(1.0, net_n);
  }

  static void step(const SteppedMechanics& m, State& y, EnergyTotals& energy, double force_n,
                   const HandDrive& drive, double h) {
    const double sign = direction(m, y, force_n, drive);
    const HandDrive middle{drive.position_m + 0.5 * h * drive.velocity_m_per_s,
                           drive.velocity_m_per_s};
    const HandDrive end{drive.position_m + h * drive.velocity_m_per_s, drive.velocity_m_per_s};
    const Rate a = rate(m, y, force_n, drive, sign);
    const Rate b = rate(m, moved(m, y, a, 0.5 * h), force_n, middle, sign);
    const Rate c = rate(m, moved(m, y, b, 0.5 * h), force_n, middle, sign);
    const Rate d = rate(m, moved(m, y, c, h), force_n, end, sign);
    const auto mean = [&](double Rate::*part) {
      return (a.*part + 2.0 * (b.*part) + 2.0 * (c.*part) + d.*part) / 6.0;
    };
    const Rate average{mean(&Rate::x),       mean(&Rate::v),        mean(&Rate::y),
                       mean(&Rate::w),       mean(&Rate::actuator), mean(&Rate::work),
                       mean(&Rate::viscous), mean(&Rate::hand),     mean(&Rate::friction)};
    y = moved(m, y, average, h);
    if (m.p.has_friction() && y.velocity_m_per_s * sign < 0.0) y.velocity_m_per_s = 0.0;
    energy.actuator_work_j += m.p.has_lag() ? h * average.work : force_n * h * average.x;
    energy.viscous_j += h * average.viscous;
    energy.friction_j +=
        m.p.has_stribeck() ? h * average.friction : m.p.friction_n * std::abs(h * average.x);
    energy.hand_work_j += h * average.hand;
  }
};

// A plant with the interface of ExactPlant. Scheme: SemiImplicitEuler or RungeKutta4.
// Realtime-safe: yes, after construction.
template <typename Scheme>
class SteppedPlant : public MovingPlant<SteppedState, double> {
  using Base = MovingPlant<SteppedState, double>;
  using Base::drive;
  using Base::motion_;
  using Base::path_;
  using Base::period_s_;

 public:
  using typename Base::Motion;
  static constexpr bool kPlain = false;

  // `substeps`: in a tick, from 1 to kMaxSubsteps.
  SteppedPlant(const PlantParameters& parameters, HandPath path, double period_s, double start_m,
               int substeps)
      : Base(std::move(path), period_s, start_m), mechanics_{parameters}, substeps_(substeps) {
    reset();
  }

  void reset() {
    motion_ = {};
    motion_.body.position_m = this->start_m_;
    if (mechanics_.p.grip) motion_.body.hand_position_m = this->start_m_;
    path_.reset();
  }

  [[nodiscard]] double kinetic_j() const { return kinetic_j(motion_); }

  [[nodiscard]] double absorbed_j(const Motion& motion) const {
    const double loss_j =
        mechanics_.p.has_friction() ? motion.energy.dissipation_j() : motion.energy.viscous_j;
    return motion.energy.actuator_work_j + loss_j;
  }
  [[nodiscard]] double net_work_j(const Motion& motion) const {
    return absorbed_j(motion) + kinetic_j(motion);
  }
  void write_truth(const Motion& motion, PlantTruth& truth) const {
    Base::write_truth(motion, mechanics_.hand_force_n(motion.body, drive(motion)),
                      kinetic_j(motion), truth);
  }
  [[nodiscard]] HandOver<double> hand_over(double force_n) const {
    HandOver<double> state = Base::hand_over(force_n, kinetic_j());
    if (!mechanics_.p.grip) {
      state.hand_position_m = state.position_m;
      state.hand_velocity_m_per_s = state.velocity_m_per_s;
    }
    if (!mechanics_.p.has_lag()) state.actuator_n = force_n;
    return state;
  }
  void take_over(const HandOver<double>& state, HandPath& path) {
    this->go_on_from(state, path);
    SteppedState& body = motion_.body;
    if (!mechanics_.p.grip) body.hand_position_m = body.hand_velocity_m_per_s = 0.0;
    this->charge_hand_with(kinetic_j() - state.kinetic_j);
  }

  [[nodiscard, gnu::always_inline]] bool try_tick(Motion& motion, double force_n) const {
    if (!motion.path.goes_on()) [[unlikely]] {
      return false;
    }
    pass(motion, force_n, drive(motion), period_s_);
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
  // As ExactPlant::advance_for(). Each piece has all substeps.
  void advance_for(double force_n, double periods) {
    this->pass_pieces(periods, [&](double fraction) {
      pass(motion_, force_n, {path_.position_m(), path_.velocity_m_per_s()}, fraction * period_s_);
    });
  }

 private:
  [[nodiscard]] double kinetic_j(const Motion& motion) const {
    const double v = motion.body.velocity_m_per_s;
    return 0.5 * mechanics_.p.mass_kg * (v * v);
  }
  [[gnu::always_inline]] void pass(Motion& motion, double force_n, HandDrive now,
                                   double duration_s) const {
    const double h = duration_s / static_cast<double>(substeps_);
    const double begin_m = now.position_m;
    for (int i = 0; i < substeps_; ++i) {
      now.position_m = begin_m + now.velocity_m_per_s * (h * static_cast<double>(i));
      Scheme::step(mechanics_, motion.body, motion.energy, force_n, now, h);
      // An unstable scheme grows by up to 1e50 in a substep. End while the numbers are finite.
      if (!Base::in_reach(motion)) [[unlikely]] {
        return;
      }
    }
  }

  SteppedMechanics mechanics_;
  int substeps_;
};

}  // namespace hapticwall
