// The exact integrator: the motion between two ticks in closed form, without friction by one
// matrix, with Coulomb friction piece by piece between the instants at which the handle stops or
// breaks loose.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/plant/energy_totals.h"
#include "core/plant/hand_path.h"
#include "core/plant/taylor_polynomial.h"
#include "core/sample.h"

namespace hapticwall {

// Body: OneBody or TwoBodies. With kFriction false nothing of friction is in the loop.
// Realtime-safe: yes, after construction.
template <typename Body, bool kFriction>
class ExactPlant {
 public:
  // What changes from tick to tick. A loop may keep a copy of its own (of the plant's), pass ticks
  // with try_tick() as long as that works, and give it back with resume().
  struct Motion {
    typename Body::State body;
    EnergyTotals energy;
    double direction = 0.0;  // of sliding: +1, -1, or 0 while the handle sticks
    StraightPath path;       // of the hand
  };

  // `friction_n`: Coulomb friction f_c ≥ 0; not read where kFriction is false.
  ExactPlant(const Body& body, HandPath path, double period_s, double start_m, double friction_n)
      : body_(body),
        path_(std::move(path)),
        period_s_(period_s),
        start_m_(start_m),
        friction_n_(friction_n) {
    reset();
  }

  void reset() {
    motion_ = {};
    motion_.body = Body::at_rest(start_m_);
    path_.reset();
  }

  [[nodiscard]] HandPath& path() { return path_; }
  [[nodiscard]] double position_m() const { return motion_.body.position_m; }
  [[nodiscard]] const EnergyTotals& energy() const { return motion_.energy; }
  [[nodiscard]] double kinetic_j() const { return body_.kinetic_j(motion_.body); }
  [[nodiscard]] std::uint64_t friction_events() const { return friction_events_; }

  [[nodiscard]] Motion motion() const {
    Motion motion = motion_;
    motion.path = path_.straight();
    return motion;
  }
  void resume(const Motion& motion) {
    motion_ = motion;
    path_.resume(motion.path);
  }
  // Work that the hand has done on the handle so far by the plant's own account: what went into the
  // actuator and the device's losses, and what still moves.
  [[nodiscard]] double net_work_j(const Motion& motion) const {
    const EnergyTotals& energy = motion.energy;
    const double loss_j = kFriction ? energy.dissipation_j() : energy.viscous_j;
    return energy.actuator_work_j + loss_j + body_.kinetic_j(motion.body);
  }
  void write_truth(const Motion& motion, PlantTruth& truth) const {
    truth.position_m = motion.body.position_m;
    truth.velocity_m_per_s = motion.body.velocity_m_per_s;
    truth.hand_path_m = motion.path.position_m;
    truth.hand_force_n = body_.hand_force_n(motion.body, drive(motion));
    truth.actuator_work_j = motion.energy.actuator_work_j;
    truth.dissipation_j = motion.energy.dissipation_j();
    truth.hand_work_j = motion.energy.hand_work_j;
    truth.kinetic_j = body_.kinetic_j(motion.body);
  }

  // A tick under the held actuator force, where nothing happens in its course: the path goes on
  // straight and the handle surely slides on. False: nothing was done, advance() is needed.
  [[nodiscard, gnu::always_inline]] bool try_tick(Motion& motion, double force_n) const {
    if (!motion.path.goes_on()) [[unlikely]] {
      return false;
    }
    if (!try_straight_tick(motion, force_n)) return false;
    motion.path.next_tick();
    return true;
  }

  // From this tick to the next under the held actuator force.
  void advance(double force_n) {
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
  [[nodiscard]] static HandDrive drive(const Motion& motion) {
    return {motion.path.position_m, motion.path.velocity_m_per_s};
  }
  [[nodiscard]] double load(const Motion& motion, double force_n) const {
    return kFriction ? force_n + motion.direction * friction_n_ : force_n;
  }

  [[gnu::always_inline]] void account(Motion& motion, double force_n,
                                      const MotionIncrement& increment) const {
    motion.energy.actuator_work_j += force_n * increment.displacement_m;
    motion.energy.viscous_j += body_.damping_n_s_per_m() * increment.velocity_squared;
    if constexpr (kFriction) {
      motion.energy.friction_j += friction_n_ * std::abs(increment.displacement_m);
    }
    motion.energy.hand_work_j += increment.hand_work_j;
  }

  // The whole tick by the scene's matrix; false where friction might interrupt it.
  [[nodiscard, gnu::always_inline]] bool try_straight_tick(Motion& motion, double force_n) const {
    const HandDrive now = drive(motion);
    const double load_n = load(motion, force_n);
    if constexpr (kFriction) {
      if (motion.direction == 0.0 ||
          !body_.surely_keeps_direction(motion.body, load_n, now, motion.direction)) {
        return false;
      }
    }
    account(motion, force_n, body_.advance_tick(motion.body, load_n, now));
    return true;
  }

  // A stretch in which the path is straight: whole levels where nothing can happen in them, Taylor
  // pieces where something might.
  void advance_piece(double force_n, double duration_s) {
    HandDrive now{path_.position_m(), path_.velocity_m_per_s()};
    double done_s = 0.0;
    int events_at_one_instant = 0;
    while (done_s < duration_s) {
      const double rest_s = duration_s - done_s;
      double step_s = try_levels(force_n, now, rest_s);
      if (step_s == 0.0) {
        step_s = std::min(level_duration(body_.deepest_level()), rest_s);
        if (done_s + step_s <= done_s) break;  // what is left is below the last digit
        const double fraction =
            advance_by_taylor(force_n, now, step_s, events_at_one_instant < kMaximumStalls);
        step_s *= fraction;
        // A stretch below the last digit of the time is no progress either.
        events_at_one_instant = done_s + step_s > done_s ? 0 : events_at_one_instant + 1;
      }
      done_s += step_s;
      now.position_m = path_.position_m() + path_.velocity_m_per_s() * done_s;
    }
  }

  [[nodiscard]] double level_duration(int level) const { return std::ldexp(period_s_, -level); }

  // The longest level that fits and in which surely nothing happens; its duration, or 0 for none.
  double try_levels(double force_n, const HandDrive& now, double rest_s) {
    for (int level = 0; level <= body_.deepest_level(); ++level) {
      const double step_s = level_duration(level);
      if (step_s > rest_s || !surely_quiet(level, force_n, now)) continue;
      if (kFriction && motion_.direction == 0.0) {
        body_.advance_stick_level(level, motion_.body, now);
      } else {
        account(motion_, force_n,
                body_.advance_level(level, motion_.body, load(motion_, force_n), now));
      }
      return step_s;
    }
    return 0.0;
  }

  [[nodiscard]] bool surely_quiet(int level, double force_n, const HandDrive& now) const {
    if constexpr (!kFriction) return true;
    if (motion_.direction == 0.0) {
      return body_.surely_sticks(level, motion_.body, force_n, now, friction_n_);
    }
    return body_.surely_slides(level, motion_.body, load(motion_, force_n), now, motion_.direction);
  }

  // Goes on to the end of the step or to the next event, whichever comes first; returns the
  // fraction of the step that was covered. Where rounding makes stop and break-loose alternate at
  // one instant, `may_break_loose` is false and the handle rests for this step.
  double advance_by_taylor(double force_n, const HandDrive& now, double step_s,
                           bool may_break_loose) {
    if constexpr (!kFriction) {
      const auto slide = body_.slide(motion_.body, force_n, now, step_s, 0.0);
      account(motion_, force_n, body_.advance(motion_.body, slide, now, 1.0));
      return 1.0;
    }
    return motion_.direction == 0.0 ? advance_sticking(force_n, now, step_s, may_break_loose)
                                    : advance_sliding(force_n, now, step_s);
  }

  double advance_sliding(double force_n, const HandDrive& now, double step_s) {
    // Just broken loose: the net force is the friction up to rounding, and must not pull back.
    const double push = motion_.body.velocity_m_per_s == 0.0 ? motion_.direction : 0.0;
    const auto slide = body_.slide(motion_.body, load(motion_, force_n), now, step_s, push);
    const auto stop = first_crossing(slide.velocity, motion_.direction);
    account(motion_, force_n, body_.advance(motion_.body, slide, now, stop.value_or(1.0)));
    if (!stop) return 1.0;
    motion_.body.velocity_m_per_s = 0.0;
    motion_.direction = 0.0;
    ++friction_events_;
    return *stop;
  }

  double advance_sticking(double force_n, const HandDrive& now, double step_s,
                          bool may_break_loose) {
    const auto stick = body_.stick(motion_.body, force_n, now, step_s);
    double theta = 1.0;
    double direction = 0.0;
    for (const double side : {1.0, -1.0}) {
      if (!may_break_loose) break;
      TaylorPolynomial reserve = stick.net_force;  // f_c - side * F_net
      for (double& c : reserve.coefficient) c *= -side;
      reserve.coefficient[0] += friction_n_;
      const auto loose = reserve.coefficient[0] < -kBreakTolerance * friction_n_
                             ? std::optional<double>(0.0)
                             : first_crossing(reserve, 1.0);
      if (loose && (*loose < theta || direction == 0.0)) {
        theta = *loose;
        direction = side;
      }
    }
    Body::advance(motion_.body, stick, theta);
    if (direction != 0.0) {
      motion_.direction = direction;
      ++friction_events_;
    }
    return theta;
  }

  // A net force beyond friction by more than this fraction breaks loose at once, whatever its
  // trend.
  static constexpr double kBreakTolerance = 1e-12;
  static constexpr int kMaximumStalls = 8;

  Body body_;
  HandPath path_;
  double period_s_;
  double start_m_;
  double friction_n_;
  Motion motion_;  // its path is set anew from path_ at every tick
  std::uint64_t friction_events_ = 0;
};

}  // namespace hapticwall
