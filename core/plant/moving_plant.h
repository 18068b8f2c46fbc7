// The common part of all plants: a state, energies, the hand's path, and the handover from one
// plant to the next during motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plant/energy_totals.h"
#include "core/plant/hand_path.h"
#include "core/sample.h"

namespace hapticwall {

// A run whose handle is farther from 0 is `diverged`.
inline constexpr double kDivergedPositionM = 1.0;
// Limit for the hand's distance from 0, as kDivergedPositionM; only an unstable integrator exceeds
// it.
inline constexpr double kRunawayHandM = 1e3;

// The state that one plant hands to the next when a session changes the scene's plant.
template <typename Real>
struct HandOver {
  Real position_m = 0;
  Real velocity_m_per_s = 0;
  Real hand_position_m = 0;  // of the handle if the hand has no mass
  Real hand_velocity_m_per_s = 0;
  Real actuator_n = 0;  // acting on the handle
  Real kinetic_j = 0;
  BasicEnergyTotals<Real> energy;
};

// State: of the body; it holds only the members that this body needs. Realtime-safe: yes, all of it
// after construction.
template <typename State, typename Real>
class MovingPlant {
 public:
  using Number = Real;
  static constexpr int kMaxPieces = 20000;  // per tick; a piece takes about 1 µs

  // Everything that changes from tick to tick. A loop may advance a copy with the plant's
  // try_tick() while that succeeds, and return the copy with resume().
  struct Motion {
    State body;
    BasicEnergyTotals<Real> energy;
    Real direction = 0;  // of sliding: +1, -1, or 0 while the handle sticks
    StraightPath path;   // of the hand
  };

  [[nodiscard]] HandPath& path() { return path_; }
  [[nodiscard]] Real position_m() const { return motion_.body.position_m; }
  [[nodiscard]] const BasicEnergyTotals<Real>& energy() const { return motion_.energy; }

  // Pieces of the motion in the last advance(); 0 if one matrix step was enough.
  [[nodiscard]] int pieces() const { return pieces_; }
  // True after a tick with more than kMaxPieces. The position is then NaN, and stays so until
  // reset().
  [[nodiscard]] bool gave_up() const { return pieces_ > kMaxPieces; }

  // False if the run has diverged: the handle is not within ±1 m, or the hand has run away.
  [[nodiscard]] static bool in_reach(const Motion& motion) {
    bool in = std::abs(motion.body.position_m) <= static_cast<Real>(kDivergedPositionM);
    if constexpr (requires { motion.body.hand_position_m; }) {
      in = in && std::abs(motion.body.hand_position_m) <= static_cast<Real>(kRunawayHandM);
    }
    return in;
  }

  [[nodiscard]] Motion motion() const {
    Motion motion = motion_;
    motion.path = path_.straight();
    return motion;
  }
  void resume(const Motion& motion) {
    motion_ = motion;
    path_.resume(motion.path);
  }

  // A force of the hand that is held through a tick acts as an opposite part of the command: the
  // caller takes it from the command of every tick. This is its change, newtons. What an amplifier
  // lags behind is the command alone.
  void push([[maybe_unused]] Real change_n) {
    if constexpr (requires(State & body) { body.actuator_n; }) motion_.body.actuator_n -= change_n;
  }
  // Counts that part of the last tick as work of the hand.
  void credit_push(Real work_j) {
    motion_.energy.actuator_work_j += work_j;
    motion_.energy.hand_work_j += work_j;
  }

 protected:
  MovingPlant(HandPath path, double period_s, double start_m)
      : path_(std::move(path)), period_s_(period_s), start_m_(start_m) {}

  [[nodiscard]] static BasicHandDrive<Real> drive(const Motion& motion) {
    return {motion.path.position_m, motion.path.velocity_m_per_s};
  }

  static void write_truth(const Motion& motion, Real hand_force_n, Real kinetic_j,
                          PlantTruth& truth) {
    truth.position_m = static_cast<double>(motion.body.position_m);
    truth.velocity_m_per_s = static_cast<double>(motion.body.velocity_m_per_s);
    truth.hand_path_m = motion.path.position_m;
    truth.hand_force_n = static_cast<double>(hand_force_n);
    truth.actuator_work_j = static_cast<double>(motion.energy.actuator_work_j);
    truth.dissipation_j = static_cast<double>(motion.energy.dissipation_j());
    truth.hand_work_j = static_cast<double>(motion.energy.hand_work_j);
    truth.kinetic_j = static_cast<double>(kinetic_j);
  }

  // `force_n`: the last command to the actuator.
  [[nodiscard]] HandOver<Real> hand_over(Real force_n, Real kinetic_j) const {
    const State& body = motion_.body;
    HandOver<Real> state{
        body.position_m, body.velocity_m_per_s, body.position_m, body.velocity_m_per_s, force_n,
        kinetic_j,       motion_.energy};
    if constexpr (requires { body.hand_position_m; }) {
      state.hand_position_m = body.hand_position_m;
      state.hand_velocity_m_per_s = body.hand_velocity_m_per_s;
    }
    if constexpr (requires { body.actuator_n; }) state.actuator_n = body.actuator_n;
    return state;
  }
  // Continues from `state` along the path of the other plant.
  void go_on_from(const HandOver<Real>& state, HandPath& path) {
    std::swap(path_, path);
    motion_.energy = state.energy;
    State& body = motion_.body;
    body.position_m = state.position_m;
    body.velocity_m_per_s = state.velocity_m_per_s;
    motion_.direction =
        static_cast<Real>((state.velocity_m_per_s > 0) - (state.velocity_m_per_s < 0));
    if constexpr (requires { body.hand_position_m; }) {
      body.hand_position_m = state.hand_position_m;
      body.hand_velocity_m_per_s = state.hand_velocity_m_per_s;
    }
    if constexpr (requires { body.actuator_n; }) body.actuator_n = state.actuator_n;
  }
  // Calls pass(fraction) for the straight pieces of a tick of this many nominal periods.
  template <typename Pass>
  void pass_pieces(double periods, const Pass& pass) {
    while (periods > 0.0) {
      const double fraction = std::min(periods, path_.piece_fraction());
      pass(fraction);
      path_.pass(fraction);
      periods -= fraction;
    }
  }
  // A change of mass changes the kinetic energy of a moving handle; the ledger charges the hand.
  void charge_hand_with(Real energy_j) { motion_.energy.hand_work_j += energy_j; }

  HandPath path_;
  double period_s_;
  double start_m_;
  int pieces_ = 0;
  Motion motion_;  // motion() fills its path from path_
};

}  // namespace hapticwall
