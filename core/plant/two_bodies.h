// The handle held by a hand that has a mass of its own, through the grip's spring-damper:
//
//   m   dv/dt   = F_g - F_a - f - b v,                             F_g = k_g (y - x) + b_g (w - v)
//   m_h dw/dt   = k_h (p - y) + b_h (p' - w) - F_g
//
// x, v the handle's and y, w the hand's position and velocity; the rest as in one_body.h. Core
// states (linear_motion.h) are a = v', d = w - v, d', u = w - s and e. A stiff grip holds d small,
// so these states stay small as well. The "hand force" F_h on the handle, whose work is in the
// ledger, is F_g.
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
    TaylorPolynomial<Real> velocity;    // v
    TaylorPolynomial<Real> hand_force;  // F_g, newtons
    TaylorPolynomial<Real> difference;  // d = w - v
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };
  struct Stick {
    TaylorPolynomial<Real> hand_velocity;  // w
    TaylorPolynomial<Real> net_force;      // F_g - F_a with the handle at rest, newtons
    LagPiece<Real, kLag> lag;
    Real duration_s = 0;
  };

  static constexpr std::size_t kStates = kLag ? 5 : 4;  // a, d, d', u[, e]
  using Row = std::array<Real, kStates>;
  struct Rows : LinearRows<Real, kLag, kStates> {
    Row difference{};  // d(h) - d(0)
    Row stretch{};     // ∫d
  };

  BasicTwoBodies(const PlantParameters& parameters, double period_s);

  // Realtime-safe: yes, all that follows.
  [[nodiscard]] static State at_rest(double position_m) {
    State state;
    state.position_m = state.hand_position_m = position_m;
    return state;
  }
  static void move_origin(State& state, Real origin_m) {
    state.position_m -= origin_m;
    state.hand_position_m -= origin_m;
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
  [[nodiscard]] Real net_force_at_rest_n(const State& state, Real force_n,
                                         const BasicHandDrive<Real>& /*drive*/) const {
    const Real net_n = grip_force(state) - force_n;
    if constexpr (kLag) return net_n - state.excess_n(force_n);
    return net_n;
  }
  [[nodiscard]] Slide slide(const State& state, const Load<Real>& load,
                            const BasicHandDrive<Real>& drive, Real duration_s, Real push) const;
  [[nodiscard]] MotionIncrement<Real> advance(State& state, const Slide& slide, Real theta) const;
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
  [[nodiscard]] Row core_states(const State& state, const Load<Real>& load,
                                const BasicHandDrive<Real>& drive) const {
    Real net_n =
        (grip_force(state) - parameters_.damping_n_s_per_m * state.velocity_m_per_s) - load.total_n;
    Row c{};
    if constexpr (kLag) {
      c[4] = state.excess_n(load.force_n);
      net_n -= c[4];
    }
    c[0] = net_n * per_mass_;
    c[1] = state.hand_velocity_m_per_s - state.velocity_m_per_s;
    c[2] = hand_acceleration(state, drive) - c[0];
    c[3] = state.hand_velocity_m_per_s - drive.velocity_m_per_s;
    return c;
  }

  // The hand alone while the handle sticks, relative to the speed w that it would settle at.
  struct StickRows {
    std::array<Real, 2> velocity{};  // change of w from (w - w_end, dw/dt)
    std::array<Real, 2> integral{};  // ∫(w - w_end)
  };

  // The speed at which the hand's force on a handle at rest would stay constant.
  [[nodiscard]] Real settling_velocity(const BasicHandDrive<Real>& drive) const {
    return hand_share_ * drive.velocity_m_per_s;
  }
  // sqrt(2E) of the relative motion's energy E; see surely_slides().
  [[nodiscard]] Real root_energy(const Row& c) const;
  void make_levels(const PlantParameters& parameters, int halvings);
  void make_stick_levels(const PlantParameters& parameters, int halvings);

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
  Real root_per_mass_;
  Real root_per_hand_mass_;
  Real jerk_per_root_energy_ = 0;
  Real drive_rate_per_root_energy_ = 0;  // bounds g' of surely_slides()
  Real self_damping_rate_per_s_ = 0;     // (b + b_g)/m
  // Numbers of the hand alone, while the handle sticks.
  Real stick_stiffness_n_per_m_;  // k_h + k_g
  Real root_stick_stiffness_;
  Real hand_share_;  // k_h/(k_h + k_g), 0 without stiffness
  std::vector<Rows> levels_;
  std::vector<StickRows> stick_levels_;
};

template <typename Real, bool kLag>
[[gnu::always_inline]] inline MotionIncrement<Real> BasicTwoBodies<Real, kLag>::advance_by(
    const Rows& rows, State& state, const Load<Real>& load,
    const BasicHandDrive<Real>& drive) const {
  const Row c = core_states(state, load, drive);
  const MotionIncrement<Real> increment =
      rows.increment(state.velocity_m_per_s, grip_force(state), c);
  const Real velocity_change = dot(rows.velocity, c);
  state.position_m += increment.displacement_m;
  state.hand_position_m += increment.displacement_m + dot(rows.stretch, c);
  state.velocity_m_per_s += velocity_change;
  state.hand_velocity_m_per_s += velocity_change + dot(rows.difference, c);
  rows.lag.settle(state, load.force_n);
  return increment;
}

template <typename Real, bool kLag>
[[gnu::always_inline]] inline Real BasicTwoBodies<Real, kLag>::root_energy(const Row& c) const {
  const Real hand_acceleration = c[0] + c[2];
  return std::sqrt(parameters_.mass_kg * c[0] * c[0] +
                   parameters_.hand_mass_kg * hand_acceleration * hand_acceleration +
                   parameters_.grip_stiffness_n_per_m * c[1] * c[1] +
                   parameters_.hand_stiffness_n_per_m * c[3] * c[3]);
}

// E = ½m a² + ½m_h (w')² + ½k_g d² + ½k_h u² is the energy of the relative motion. Only a lag adds
// to it, a power of at most |a e|/τ, so sqrt(2E) grows by at most ∫|e|/(τ sqrt(m)) dt. It bounds a,
// a' and, for a handle that creeps, the change of g = a + (b + b_g)/m v, the drive without the
// damping of v itself: m g' = k_g d + b_g w' + e/τ. Conditions 1 to 3 of one_body.h apply.
template <typename Real, bool kLag>
[[gnu::always_inline]] inline bool BasicTwoBodies<Real, kLag>::surely_slides(
    const Rows& rows, const State& state, const Load<Real>& load, const BasicHandDrive<Real>& drive,
    Real direction) const {
  const Row c = core_states(state, load, drive);
  Real root = root_energy(c);
  Real jerk = 0;
  Real settling = 0;
  if constexpr (kLag) {
    const Real excess_n = std::abs(c[4]);
    root += rows.lag.settled_fraction * excess_n * root_per_mass_;
    jerk = lag_.rate_per_s * excess_n * per_mass_;
    settling = rows.lag.settled_fraction * excess_n * per_mass_;
  }
  const Real h = rows.duration_s;
  const Real v = direction * state.velocity_m_per_s;
  const Real bend = h * h / 2 * (jerk_per_root_energy_ * root + jerk);
  return v > h * root * root_per_mass_ || v + std::min(Real(0), direction * c[0] * h) > bend ||
         (v > 0 && direction * c[0] + self_damping_rate_per_s_ * v >
                       h * drive_rate_per_root_energy_ * root + settling);
}

// The net force changes at the rate k_g w + b_g w'. The energy ½m_h w'² + ½(k_h + k_g)(w - w_end)²
// never grows, which bounds both terms. A lag's excess decays to a known value.
template <typename Real, bool kLag>
[[gnu::always_inline]] inline bool BasicTwoBodies<Real, kLag>::surely_sticks(
    int level, const State& state, Real force_n, const BasicHandDrive<Real>& drive,
    Real friction_n) const {
  const Parameters& p = parameters_;
  const Rows& rows = this->level(level);
  const Real h = rows.duration_s;
  const Real end = settling_velocity(drive);
  const Real u = state.hand_velocity_m_per_s - end;
  const Real a = hand_acceleration(state, drive);
  const Real root_energy = std::sqrt(p.hand_mass_kg * a * a + stick_stiffness_n_per_m_ * u * u);
  const Real most_a = root_energy * root_per_hand_mass_;
  Real most_w = std::abs(state.hand_velocity_m_per_s) + h * most_a;
  if (stick_stiffness_n_per_m_ > 0) {
    most_w = std::min(most_w, std::abs(end) + root_energy / root_stick_stiffness_);
  }
  Real change_n = h * (p.grip_stiffness_n_per_m * most_w + p.grip_damping_n_s_per_m * most_a);
  Real net_n = grip_force(state) - force_n;
  if constexpr (kLag) {
    const Real excess_n = state.excess_n(force_n);
    net_n -= excess_n;
    change_n += rows.lag.settled_fraction * std::abs(excess_n);
  }
  return std::abs(net_n) + change_n <= friction_n;
}

template <typename Real, bool kLag>
[[gnu::always_inline]] inline void BasicTwoBodies<Real, kLag>::advance_stick_level(
    int level, State& state, Real force_n, const BasicHandDrive<Real>& drive) const {
  const Rows& rows = this->level(level);
  const StickRows& stick = stick_levels_[static_cast<std::size_t>(level)];
  const Real end = settling_velocity(drive);
  const Real u = state.hand_velocity_m_per_s - end;
  const Real a = hand_acceleration(state, drive);
  state.hand_position_m += end * rows.duration_s + (stick.integral[0] * u + stick.integral[1] * a);
  state.hand_velocity_m_per_s += stick.velocity[0] * u + stick.velocity[1] * a;
  rows.lag.settle(state, force_n);
}

}  // namespace hapticwall
