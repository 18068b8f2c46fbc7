// The exact integrator: the motion between two ticks in closed form, without friction by one
// matrix, with Coulomb friction piece by piece between the instants at which the handle stops or
// breaks loose.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/plant/energy_totals.h"
#include "core/plant/moving_plant.h"
#include "core/plant/taylor_polynomial.h"
#include "core/sample.h"

namespace hapticwall {

// Body: BasicOneBody or BasicTwoBodies. With kFriction false nothing of friction is in the loop.
// Realtime-safe: yes, after construction.
template <typename Body, bool kFriction>
class ExactPlant : public MovingPlant<typename Body::State, typename Body::Number> {
  using Base = MovingPlant<typename Body::State, typename Body::Number>;
  using Real = typename Body::Number;
  using Drive = BasicHandDrive<Real>;
  using Base::drive;
  using Base::motion_;
  using Base::path_;
  using Base::period_s_;

 public:
  using typename Base::Motion;
  // Nothing optional in it: its tick is so short that what is around it counts.
  static constexpr bool kPlain = !kFriction && !Body::kHasLag;

  // `friction_n`: Coulomb friction f_c ≥ 0; not read where kFriction is false.
  ExactPlant(const Body& body, HandPath path, double period_s, double start_m, double friction_n)
      : Base(std::move(path), period_s, start_m), body_(body), friction_n_(friction_n) {
    reset();
  }

  void reset() {
    motion_ = {};
    motion_.body = Body::at_rest(this->start_m_);
    path_.reset();
  }

  [[nodiscard]] Real kinetic_j() const { return body_.kinetic_j(motion_.body); }
  [[nodiscard]] std::uint64_t friction_events() const { return friction_events_; }

  // Work that the hand has done on the handle so far by the plant's own account: what went into the
  // actuator and the device's losses, and what still moves.
  [[nodiscard]] Real net_work_j(const Motion& motion) const {
    const BasicEnergyTotals<Real>& energy = motion.energy;
    const Real loss_j = kFriction ? energy.dissipation_j() : energy.viscous_j;
    return energy.actuator_work_j + loss_j + body_.kinetic_j(motion.body);
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

  // A tick under the held actuator force, where nothing happens in its course: the path goes on
  // straight and the handle surely slides on. False: nothing was done, advance() is needed.
  [[nodiscard, gnu::always_inline]] bool try_tick(Motion& motion, Real force_n) const {
    if (!motion.path.goes_on()) [[unlikely]] {
      return false;
    }
    if (!try_straight_tick(motion, force_n)) return false;
    motion.path.next_tick();
    return true;
  }

  // From this tick to the next under the held actuator force.
  void advance(Real force_n) {
    motion_.path = path_.straight();
    if (path_.bends_within_tick()) {
      do {
        advance_piece(force_n, path_.piece_fraction() * period_s_);
      } while (path_.next_piece());
    } else if (!try_straight_tick(motion_, force_n)) {
      advance_piece(force_n, period_s_);
    }
    path_.next_tick();
  }

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

  // The whole tick by the scene's matrix; false where friction might interrupt it.
  [[nodiscard, gnu::always_inline]] bool try_straight_tick(Motion& motion, Real force_n) const {
    const Drive now = drive(motion);
    const Load<Real> total = load(motion, force_n);
    if constexpr (kFriction) {
      if (motion.direction == 0 ||
          !body_.surely_slides(body_.level(0), motion.body, total, now, motion.direction)) {
        return false;
      }
    }
    account(motion, force_n, body_.advance_by(body_.level(0), motion.body, total, now));
    return true;
  }

  // A stretch in which the path is straight: whole levels where nothing can happen in them, Taylor
  // pieces where something might.
  void advance_piece(Real force_n, Real duration_s) {
    // Small displacements must not drown in a large position: the origin moves to the handle.
    const Real origin_m = motion_.body.position_m;
    Body::move_origin(motion_.body, origin_m);
    const Real begin_m = path_.position_m() - origin_m;
    Drive now{begin_m, path_.velocity_m_per_s()};
    Real done_s = 0;
    int events_at_one_instant = 0;
    int stalls = 0;
    stop_if_spent();
    while (done_s < duration_s) {
      const Real rest_s = duration_s - done_s;
      Real step_s = try_levels(force_n, now, rest_s);
      if (step_s == 0 && events_at_one_instant > kMostEventsAtOneInstant) {
        step_s = rest_for_a_while(force_n, now, rest_s, stalls++);
        events_at_one_instant = 0;
      }
      if (step_s == 0) {
        step_s = std::min(level_duration(body_.deepest_level()), rest_s);
        if (done_s + step_s <= done_s) break;  // what is left is below the last digit
        step_s *= advance_by_taylor(force_n, now, step_s);
        // A stretch below the last digit of the time is no progress either.
        events_at_one_instant = done_s + step_s > done_s ? 0 : events_at_one_instant + 1;
      }
      done_s += step_s;
      now.position_m = begin_m + path_.velocity_m_per_s() * done_s;
    }
    Body::move_origin(motion_.body, -origin_m);
  }

  [[nodiscard]] Real level_duration(int level) const {
    return std::ldexp(static_cast<Real>(period_s_), -level);
  }

  // The longest level that fits and in which surely nothing happens; its duration, or 0 for none.
  Real try_levels(Real force_n, const Drive& now, Real rest_s) {
    for (int level = 0; level <= body_.deepest_level(); ++level) {
      const Real step_s = level_duration(level);
      if (step_s > rest_s || !surely_quiet(level, force_n, now)) continue;
      if (kFriction && motion_.direction == 0) {
        body_.advance_stick_level(level, motion_.body, force_n, now);
      } else {
        account(motion_, force_n,
                body_.advance_by(body_.level(level), motion_.body, load(motion_, force_n), now));
        stop_if_spent();
      }
      return step_s;
    }
    return 0;
  }

  // Where rounding makes stop and break-loose alternate at one instant, the handle rests: for the
  // shortest step at first, for twice as long whenever that happens again in the same stretch.
  // Returns how long; 0 where even the shortest step is too long.
  Real rest_for_a_while(Real force_n, const Drive& now, Real rest_s, int stalls) {
    for (int level = std::max(0, body_.deepest_level() - stalls); level <= body_.deepest_level();
         ++level) {
      if (level_duration(level) > rest_s) continue;
      if (motion_.direction != 0) stop();
      body_.advance_stick_level(level, motion_.body, force_n, now);
      return level_duration(level);
    }
    return 0;
  }

  // A handle that has crept until its velocity is nothing but rounding has come to rest.
  void stop_if_spent() {
    if constexpr (kFriction) {
      if (motion_.direction * motion_.body.velocity_m_per_s > 0 || motion_.direction == 0) return;
      stop();
    }
  }
  void stop() {
    motion_.body.velocity_m_per_s = 0;
    motion_.direction = 0;
    ++friction_events_;
  }

  [[nodiscard]] bool surely_quiet(int level, Real force_n, const Drive& now) const {
    if constexpr (!kFriction) return true;
    if (motion_.direction == 0) {
      return body_.surely_sticks(level, motion_.body, force_n, now,
                                 friction_n_ + rounding_n(force_n, now));
    }
    return body_.surely_slides(body_.level(level), motion_.body, load(motion_, force_n), now,
                               motion_.direction);
  }

  // Goes on to the end of the step or to the next event, whichever comes first; returns the
  // fraction of the step that was covered.
  Real advance_by_taylor(Real force_n, const Drive& now, Real step_s) {
    if constexpr (!kFriction) {
      const auto slide = body_.slide(motion_.body, load(motion_, force_n), now, step_s, 0);
      account(motion_, force_n, body_.advance(motion_.body, slide, 1));
      return 1;
    }
    return motion_.direction == 0 ? advance_sticking(force_n, now, step_s)
                                  : advance_sliding(force_n, now, step_s);
  }

  Real advance_sliding(Real force_n, const Drive& now, Real step_s) {
    // Just broken loose: the net force is the friction up to rounding, and must not pull back.
    const Real push = motion_.body.velocity_m_per_s == 0 ? motion_.direction : 0;
    const auto slide = body_.slide(motion_.body, load(motion_, force_n), now, step_s, push);
    const auto stopped = first_crossing(slide.velocity, motion_.direction);
    account(motion_, force_n, body_.advance(motion_.body, slide, stopped.value_or(1)));
    if (!stopped) return 1;
    stop();
    return *stopped;
  }

  Real advance_sticking(Real force_n, const Drive& now, Real step_s) {
    const Real rounding = rounding_n(force_n, now);
    const auto stick = body_.stick(motion_.body, force_n, now, step_s);
    Real theta = 1;
    Real direction = 0;
    for (const Real side : {Real(1), Real(-1)}) {
      TaylorPolynomial<Real> reserve = stick.net_force;  // f_c - side * F_net
      for (Real& c : reserve.coefficient) c *= -side;
      reserve.coefficient[0] += friction_n_;
      const auto loose = reserve.coefficient[0] < -rounding ? std::optional<Real>(0)
                                                            : first_crossing(reserve, Real(1));
      if (loose && (*loose < theta || direction == 0)) {
        theta = *loose;
        direction = side;
      }
    }
    Body::advance(motion_.body, stick, theta);
    if (direction != 0) {
      motion_.direction = direction;
      ++friction_events_;
    }
    return theta;
  }

  // What a net force is known to: beyond friction by more than this it breaks loose at once,
  // whatever its trend.
  [[nodiscard]] Real rounding_n(Real force_n, const Drive& now) const {
    constexpr Real kLastDigits = 8 * std::numeric_limits<Real>::epsilon();
    return kLastDigits *
           (std::abs(body_.hand_force_n(motion_.body, now)) + std::abs(force_n) + friction_n_);
  }

  static constexpr int kMostEventsAtOneInstant = 8;

  Body body_;
  Real friction_n_;
  std::uint64_t friction_events_ = 0;
};

}  // namespace hapticwall
