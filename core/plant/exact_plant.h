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
  // `friction_n`: Coulomb friction f_c ≥ 0; not read where kFriction is false.
  ExactPlant(Body body, HandPath path, double period_s, double friction_n)
      : body_(std::move(body)),
        path_(std::move(path)),
        period_s_(period_s),
        friction_n_(friction_n) {}

  void reset() {
    body_.reset();
    path_.reset();
    energy_ = {};
    direction_ = 0.0;
  }

  [[nodiscard]] HandPath& path() { return path_; }
  [[nodiscard]] double position_m() const { return body_.position_m(); }
  [[nodiscard]] const EnergyTotals& energy() const { return energy_; }
  [[nodiscard]] double kinetic_j() const { return body_.kinetic_j(); }
  [[nodiscard]] std::uint64_t friction_events() const { return friction_events_; }

  void write_truth(PlantTruth& truth) const {
    truth.position_m = body_.position_m();
    truth.velocity_m_per_s = body_.velocity_m_per_s();
    truth.hand_path_m = path_.position_m();
    truth.hand_force_n = body_.hand_force_n(drive());
    truth.actuator_work_j = energy_.actuator_work_j;
    truth.dissipation_j = energy_.dissipation_j();
    truth.hand_work_j = energy_.hand_work_j;
    truth.kinetic_j = body_.kinetic_j();
  }

  // From this tick to the next under the held actuator force.
  void advance(double force_n) {
    if (path_.bends_within_tick()) [[unlikely]] {
      do {
        advance_piece(force_n, path_.piece_fraction() * period_s_);
      } while (path_.next_piece());
    } else if constexpr (kFriction) {
      const HandDrive now = drive();
      if (direction_ != 0.0 && body_.surely_keeps_direction(load(force_n), now, direction_)) {
        account(force_n, body_.advance_tick(load(force_n), now));
      } else {
        advance_piece(force_n, period_s_);
      }
    } else {
      account(force_n, body_.advance_tick(force_n, drive()));
    }
    path_.next_tick();
  }

 private:
  [[nodiscard]] HandDrive drive() const { return {path_.position_m(), path_.velocity_m_per_s()}; }
  [[nodiscard]] double load(double force_n) const { return force_n + direction_ * friction_n_; }

  void account(double force_n, const MotionIncrement& increment) {
    energy_.actuator_work_j += force_n * increment.displacement_m;
    energy_.viscous_j += body_.damping_n_s_per_m() * increment.velocity_squared;
    if constexpr (kFriction) {
      energy_.friction_j += friction_n_ * std::abs(increment.displacement_m);
    }
    energy_.hand_work_j += increment.hand_work_j;
  }

  // A stretch in which the path is straight, in steps within the Taylor polynomials' reach.
  void advance_piece(double force_n, double duration_s) {
    HandDrive now = drive();
    double done_s = 0.0;
    int events_at_one_instant = 0;
    while (done_s < duration_s) {
      double step_s = std::min(body_.longest_stretch_s(), duration_s - done_s);
      if (done_s + step_s <= done_s) break;  // what is left is below the last digit
      if constexpr (kFriction) {
        const double fraction =
            advance_with_friction(force_n, now, step_s, events_at_one_instant < kMaximumStalls);
        events_at_one_instant = fraction > 0.0 ? 0 : events_at_one_instant + 1;
        step_s *= fraction;
      } else {
        account(force_n, body_.advance(body_.slide(force_n, now, step_s, 0.0), now, 1.0));
      }
      done_s += step_s;
      now.position_m = path_.position_m() + path_.velocity_m_per_s() * done_s;
    }
  }

  // Goes on to the end of the step or to the next event, whichever comes first; returns the
  // fraction of the step that was covered. Where rounding makes stop and break-loose alternate at
  // one instant, `may_break_loose` is false and the handle rests for this step.
  double advance_with_friction(double force_n, const HandDrive& now, double step_s,
                               bool may_break_loose) {
    return direction_ == 0.0 ? advance_sticking(force_n, now, step_s, may_break_loose)
                             : advance_sliding(force_n, now, step_s);
  }

  double advance_sliding(double force_n, const HandDrive& now, double step_s) {
    // Just broken loose: the net force is the friction up to rounding, and must not pull back.
    const double push = body_.velocity_m_per_s() == 0.0 ? direction_ : 0.0;
    const auto slide = body_.slide(load(force_n), now, step_s, push);
    const auto stop = first_crossing(slide.velocity, direction_);
    account(force_n, body_.advance(slide, now, stop.value_or(1.0)));
    if (!stop) return 1.0;
    body_.stop();
    direction_ = 0.0;
    ++friction_events_;
    return *stop;
  }

  double advance_sticking(double force_n, const HandDrive& now, double step_s,
                          bool may_break_loose) {
    const auto stick = body_.stick(force_n, now, step_s);
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
    body_.advance(stick, theta);
    if (direction != 0.0) {
      direction_ = direction;
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
  double friction_n_;
  EnergyTotals energy_;
  double direction_ = 0.0;  // of sliding: +1, -1, or 0 while the handle sticks
  std::uint64_t friction_events_ = 0;
};

}  // namespace hapticwall
