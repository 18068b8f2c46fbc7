// The least that a simulation of a handle with Coulomb friction must do: ask whether a handle at
// rest stays so through the tick, propagate one that slides, and find the first zero of its
// velocity in closed form. Written by hand, without ledger, metrics, encoder, options or algorithm:
// the peer of the rows with friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "core/scene.h"

namespace hapticwall::benchmark_loops {

struct FrictionState {
  double position_m = 0.0;
  std::uint64_t events = 0;  // stops and breaks
};

// A hand without grip, a path of one ramp, one undamped wall, a force limit; underdamped.
class FrictionLoop {
 public:
  explicit FrictionLoop(const Scene& scene)
      : wall_(scene.x().walls.at(0)),
        limit_n_(scene.x().device.force_limit_n.value()),
        friction_n_(scene.x().device.friction_n.value()),
        hand_(scene.x().hand.value()),
        mass_kg_(scene.x().device.mass_kg + hand_.mass_kg.value_or(0.0)),
        half_((scene.x().device.damping_n_s_per_m + hand_.damping_n_s_per_m) / mass_kg_ / 2.0),
        omega_(std::sqrt(hand_.stiffness_n_per_m / mass_kg_ - half_ * half_)),
        damping_(scene.x().device.damping_n_s_per_m),
        start_m_(scene.x().device.start_m),
        period_s_(scene.sampling.period_s()),
        ticks_(scene.tick_count()),
        ramp_ticks_(
            static_cast<std::uint64_t>(std::lround(hand_.path[1].time_s * scene.sampling.rate_hz))),
        ramp_speed_((hand_.path[1].position_m - hand_.path[0].position_m) /
                    (static_cast<double>(ramp_ticks_) * period_s_)) {
    if (!(omega_ > 0.0)) throw std::invalid_argument("an underdamped hand is needed");
    tick_ = response(period_s_);
  }

  [[nodiscard]] FrictionState run() const {
    Motion now{.x = start_m_, .path = start_m_};
    for (std::uint64_t tick = 0; tick < ticks_; ++tick) {
      now.s = tick < ramp_ticks_ ? ramp_speed_ : 0.0;
      const double force_n =
          std::min(limit_n_, std::max(0.0, wall_.stiffness_n_per_m * (now.x - wall_.position_m)));
      if (now.direction == 0.0 && sticks(now, force_n, period_s_)) {
        now.path += now.s * period_s_;
      } else if (now.direction == 0.0 || !slides(now, force_n)) {
        pass_with_events(now, force_n);
      }
    }
    return {now.x, now.events};
  }

 private:
  struct Motion {
    double x = 0.0;
    double v = 0.0;
    double direction = 0.0;  // of sliding; 0 at rest
    double path = 0.0;
    double s = 0.0;  // speed of the path
    std::uint64_t events = 0;
  };
  // u = v - s after a time: u(t) = uu u + ua a, its integral, and a(t) = au u + aa a.
  struct Response {
    double uu, ua, iu, ia, au, aa;
  };

  [[nodiscard]] Response response(double t) const {
    const double decay = std::exp(-half_ * t);
    const double sine = decay * std::sin(omega_ * t) / omega_;
    const double cosine = decay * std::cos(omega_ * t);
    const double square = half_ * half_ + omega_ * omega_;
    Response r{cosine + half_ * sine, sine, 0.0, 0.0, -square * sine, cosine - half_ * sine};
    r.ia = (1.0 - r.uu) / square;
    r.iu = r.ua + 2.0 * half_ * r.ia;
    return r;
  }

  // Force of the hand on a handle at rest, less the actuator's force.
  [[nodiscard]] double net_at_rest(const Motion& m, double force_n) const {
    return hand_.stiffness_n_per_m * (m.path - m.x) + hand_.damping_n_s_per_m * m.s - force_n;
  }
  [[nodiscard]] bool sticks(const Motion& m, double force_n, double time_s) const {
    const double begin_n = net_at_rest(m, force_n);
    const double end_n = begin_n + hand_.stiffness_n_per_m * m.s * time_s;
    return std::max(std::abs(begin_n), std::abs(end_n)) <= friction_n_;
  }
  [[nodiscard]] double acceleration(const Motion& m, double force_n) const {
    return (net_at_rest(m, force_n) - (hand_.damping_n_s_per_m + damping_) * m.v -
            m.direction * friction_n_) /
           mass_kg_;
  }

  // The whole tick, if the velocity keeps its sign; it has at most one extremum.
  bool slides(Motion& m, double force_n) const {
    const double a = acceleration(m, force_n);
    const double u = m.v - m.s;
    const double v = m.s + tick_.uu * u + tick_.ua * a;
    const double end_a = tick_.au * u + tick_.aa * a;
    if (v * m.direction <= 0.0 || (a * m.direction < 0.0 && end_a * m.direction > 0.0)) {
      return false;
    }
    m.x += m.s * period_s_ + tick_.iu * u + tick_.ia * a;
    m.v = v;
    m.path += m.s * period_s_;
    return true;
  }

  void pass_with_events(Motion& m, double force_n) const {
    double rest_s = period_s_;
    while (rest_s > 0.0) {
      if (m.direction == 0.0) {
        if (sticks(m, force_n, rest_s)) {
          m.path += m.s * rest_s;
          return;
        }
        rest_s -= break_loose(m, force_n);
      } else {
        rest_s -= slide(m, force_n, rest_s);
      }
    }
  }

  // Returns the time until the net force reaches the friction.
  double break_loose(Motion& m, double force_n) const {
    const double net_n = net_at_rest(m, force_n);
    const double rate = hand_.stiffness_n_per_m * m.s;
    m.direction =
        std::abs(net_n) > friction_n_ ? std::copysign(1.0, net_n) : (rate > 0 ? 1.0 : -1.0);
    const double time_s =
        std::abs(net_n) > friction_n_ ? 0.0 : (m.direction * friction_n_ - net_n) / rate;
    m.path += m.s * time_s;
    ++m.events;
    return time_s;
  }

  // Slides until the velocity is zero, or to the end of the rest; returns the time.
  double slide(Motion& m, double force_n, double rest_s) const {
    const double a = acceleration(m, force_n);
    const double u = m.v - m.s;
    const double zero_s = first_zero(m, u, a, rest_s);
    const double time_s = std::min(zero_s, rest_s);
    const Response r = response(time_s);
    m.x += m.s * time_s + r.iu * u + r.ia * a;
    m.path += m.s * time_s;
    m.v = m.s + r.uu * u + r.ua * a;
    if (zero_s <= rest_s) {
      m.v = 0.0;
      m.direction = 0.0;
      ++m.events;
    }
    return time_s;
  }

  [[nodiscard]] double first_zero(const Motion& m, double u, double a, double rest_s) const {
    constexpr double kNever = 1e9;
    if (m.s == 0.0) {
      // u cos ωt + (a + σu)/ω sin ωt = 0.
      const double angle = std::atan2(-u * omega_, a + half_ * u);
      const double first = angle > 1e-12 ? angle : angle + std::numbers::pi;
      return (u == 0.0 ? std::numbers::pi : first) / omega_;
    }
    if (m.v == 0.0 || (m.v + a * rest_s) * m.direction > 0.0) return kNever;
    double time_s = -m.v / a;
    for (int i = 0; i < 4; ++i) {
      const Response r = response(time_s);
      time_s -= (m.s + r.uu * u + r.ua * a) / (r.au * u + r.aa * a);
    }
    return time_s;
  }

  WallSettings wall_;
  double limit_n_;
  double friction_n_;
  HandSettings hand_;
  double mass_kg_;
  double half_;   // (b + b_h)/2m
  double omega_;  // of the damped oscillation
  double damping_;
  double start_m_;
  double period_s_;
  std::uint64_t ticks_;
  std::uint64_t ramp_ticks_;
  double ramp_speed_;
  Response tick_{};
};

}  // namespace hapticwall::benchmark_loops
