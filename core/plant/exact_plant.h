// The exact integrator: the motion between two ticks in closed form. Without friction one matrix
// gives it; with Coulomb friction it is computed piece by piece between stops and breakaways.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/plant/energy_totals.h"
#include "core/plant/moving_plant.h"
#include "core/sample.h"

namespace hapticwall {

// Body: a LinearBody. Without kFriction the loop has no code for friction. The
// members that are not inline are instantiated in exact_plant.cpp. Realtime-safe: yes, after
// construction.
template <typename Body, bool kFriction>
class ExactPlant : public MovingPlant<typename Body::State, typename Body::Number> {
  using Base = MovingPlant<typename Body::State, typename Body::Number>;
  using Real = typename Body::Number;
  using Drive = BasicHandDrive<Real>;
  using Base::drive;
  using Base::motion_;
  using Base::path_;
  using Base::period_s_;
  using Base::pieces_;

 public:
  using typename Base::Motion;
  // Without an amplifier's lag the tick is so short that the cost of the loop matters.
  static constexpr bool kPlain = !Body::kHasLag;

  // `friction_n`: Coulomb friction f_c ≥ 0; not read if kFriction is false.
  ExactPlant(const Body& body, HandPath path, double period_s, double start_m, double friction_n)
      : Base(std::move(path), period_s, start_m), body_(body), friction_n_(friction_n) {
    reset();
  }

  void reset() {
    motion_ = {};
    pieces_ = 0;
    motion_.body = Body::at_rest(this->start_m_);
    path_.reset();
  }

  // Kinetic energy of the handle. A hand that grips it has its own, outside of the balance.
  [[nodiscard]] Real kinetic_j() const { return body_.kinetic_j(motion_.body); }
  // Stops and breakaways since construction; reset() does not clear them.
  [[nodiscard]] std::uint64_t friction_events() const { return friction_events_; }

  // Energy that actuator and losses have taken so far.
  [[nodiscard]] Real absorbed_j(const Motion& motion) const {
    const BasicEnergyTotals<Real>& energy = motion.energy;
    const Real loss_j = kFriction ? energy.dissipation_j() : energy.viscous_j;
    return energy.actuator_work_j + loss_j;
  }
  // The hand's work on the handle so far, as the sum of actuator work, losses and kinetic energy.
  [[nodiscard]] Real net_work_j(const Motion& motion) const {
    return absorbed_j(motion) + body_.kinetic_j(motion.body);
  }
  void write_truth(const Motion& motion, PlantTruth& truth) const {
    Base::write_truth(motion, body_.hand_force_n(motion.body, drive(motion)),
                      body_.kinetic_j(motion.body), truth);
  }
  [[nodiscard]] HandOver<Real> hand_over(Real force_n) const {
    return Base::hand_over(force_n, kinetic_j());
  }
  void take_over(const HandOver<Real>& state, HandPath& path) {
    this->go_on_from(state, path);
    this->charge_hand_with(kinetic_j() - state.kinetic_j);
  }

  // One tick under the held actuator force with a straight path and without stick-slip events.
  // False: nothing was done, advance() is needed.
  [[nodiscard, gnu::always_inline]] bool try_tick(Motion& motion, Real force_n) const {
    if (!motion.path.goes_on()) [[unlikely]] {
      return false;
    }
    if (!try_straight_tick(motion, force_n)) return false;
    motion.path.next_tick();
    return true;
  }

  // Advances to the next tick under the held actuator force. A fast rate of the body and friction
  // may need more than kMaxPieces pieces: then the plant gives up.
  void advance(Real force_n);
  // The same for a tick of this many nominal periods, greater than 0. The path allows any period.
  void advance_for(Real force_n, double periods);

 private:
  [[nodiscard]] Load<Real> load(const Motion& motion, Real force_n) const {
    return {force_n, kFriction ? force_n + motion.direction * friction_n_ : force_n};
  }

  [[gnu::always_inline]] void account(Motion& motion, Real force_n,
                                      const MotionIncrement<Real>& increment) const {
    motion.energy.actuator_work_j += force_n * increment.displacement_m;
    if constexpr (Body::kHasLag) motion.energy.actuator_work_j += increment.lag_work_j;
    motion.energy.viscous_j += body_.damping_n_s_per_m() * increment.velocity_squared;
    if constexpr (kFriction) {
      motion.energy.friction_j += friction_n_ * std::abs(increment.displacement_m);
    }
    motion.energy.hand_work_j += increment.hand_work_j;
  }

  // The whole tick by the scene's matrix; false if friction might interrupt it.
  [[nodiscard, gnu::always_inline]] bool try_straight_tick(Motion& motion, Real force_n) const {
    const Drive now = drive(motion);
    const Load<Real> total = load(motion, force_n);
    if constexpr (kFriction) {
      if (motion.direction == 0) return try_sticking_tick(motion, force_n);
      if (!body_.surely_slides(body_.level(0), motion.body, total, now, motion.direction)) {
        return false;
      }
    }
    account(motion, force_n, body_.advance_by(body_.level(0), motion.body, total, now));
    return true;
  }

  // Relative to the handle, as advance_piece() does it: with the same bits.
  [[nodiscard, gnu::always_inline]] bool try_sticking_tick(Motion& motion, Real force_n) const {
    const Real origin_m = motion.body.position_m;
    typename Body::State body = motion.body;
    Body::move_origin(body, origin_m);
    Drive now = drive(motion);
    now.position_m -= origin_m;
    if (!body_.surely_sticks(body_.level(0), body, force_n, now,
                             friction_n_ + rounding_n(body, force_n, now))) {
      return false;
    }
    body_.advance_sticking(body_.level(0), body, force_n, now);
    Body::move_origin(body, -origin_m);
    motion.body = body;
    return true;
  }

  // A stretch with a straight path: whole levels while no event is possible in them, else Taylor
  // pieces. 1 as the first level: the whole tick has been tried.
  void advance_piece(Real force_n, Real duration_s, int first_level);
  Real try_levels(int first_level, Real force_n, const Drive& now, Real rest_s);
  Real rest_for_a_while(Real force_n, const Drive& now, Real rest_s, int stalls);
  void stop_if_spent();
  void stop();
  void break_loose(Real direction);
  [[nodiscard]] bool surely_quiet(int level, Real force_n, const Drive& now) const;
  Real advance_by_taylor(Real force_n, const Drive& now, Real step_s);
  Real advance_sliding(Real force_n, const Drive& now, Real step_s);
  Real advance_sticking(Real force_n, const Drive& now, Real step_s);
  // Rounding error of a net force. A net force beyond friction by more than this breaks the handle
  // loose at once, whatever its trend.
  [[nodiscard]] Real rounding_n(const typename Body::State& body, Real force_n,
                                const Drive& now) const {
    constexpr Real kLastDigits = 8 * std::numeric_limits<Real>::epsilon();
    return kLastDigits *
           (std::abs(body_.hand_force_n(body, now)) + std::abs(force_n) + friction_n_);
  }

  static constexpr int kMaxEventsAtOneInstant = 8;

  Body body_;
  Real friction_n_;
  std::uint64_t friction_events_ = 0;
};

}  // namespace hapticwall
