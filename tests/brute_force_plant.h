// A reference for the plant that shares nothing with it: the equations of motion written out and
// integrated by Runge-Kutta in extended precision with very many small steps. Tests only.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

namespace hapticwall::testing {

using Real = long double;

// Output from a command to the amplifier, written straight from its definition: rounded to the
// nearest whole multiple of the resolution (the even one of two), within the limit, as many ticks
// later as the delay says, nothing before that.
struct BruteForceOutput {
  Real resolution = 0, limit = 0;  // 0: none
  std::size_t delay = 0;
  std::deque<Real> waiting{};

  [[nodiscard]] Real rounded(Real force) const {
    if (resolution <= 0) return force;
    const Real below = std::floor(force / resolution);
    const Real rest = force / resolution - below;
    const bool up = rest > 0.5L || (rest == 0.5L && std::fmod(below, 2.0L) != 0);
    return resolution * (up ? below + 1 : below);
  }
  Real pass(Real command) {
    const Real force = rounded(command);
    waiting.push_back(limit > 0 ? std::min(std::max(force, -limit), limit) : force);
    if (waiting.size() <= delay) return 0;
    const Real oldest = waiting.front();
    waiting.pop_front();
    return oldest;
  }
};

// m dv/dt = F_h - F_a - b v - f_c sgn(v). With hand_mass > 0 the hand grips through kg, bg; else
// its spring-damper acts on the handle itself. With a time_constant the amplifier's force F_a lags
// behind the one that it is told, F_a' = (F - F_a)/tau; else it is that.
struct BruteForcePlant {
  Real mass = 1, damping = 0, friction = 0;
  Real hand_mass = 0, hand_stiffness = 0, hand_damping = 0, grip_stiffness = 0, grip_damping = 0;
  // The arguments are the time, and a time inside the straight piece that is meant.
  std::function<Real(Real, Real)> path = [](Real, Real) { return Real{0}; };
  std::function<Real(Real)> path_velocity = [](Real) { return Real{0}; };

  Real time_constant = 0;

  Real time = 0, x = 0, v = 0, y = 0, w = 0, actuator = 0;
  Real actuator_work = 0, dissipation = 0, hand_work = 0;
  bool sticks = true;
  int events = 0;

  [[nodiscard]] Real hand_force(Real t, Real px, Real pv, Real py, Real pw) const {
    if (hand_mass > 0) return grip_stiffness * (py - px) + grip_damping * (pw - pv);
    return hand_stiffness * (path(t, middle_) - px) + hand_damping * (path_velocity(middle_) - pv);
  }

  struct Derivative {
    Real x, v, y, w, actuator, work, dissipation, hand;
  };
  [[nodiscard]] Real acting(Real force, Real lagging) const {
    return time_constant > 0 ? lagging : force;
  }

  [[nodiscard]] Derivative derive(Real t, Real px, Real pv, Real py, Real pw, Real pa, Real force,
                                  Real sign) const {
    const Real fh = hand_force(t, px, pv, py, pw);
    const bool still = sign == 0 && friction > 0;
    Derivative d{};
    d.x = still ? 0 : pv;
    d.v = still ? 0 : (fh - acting(force, pa) - damping * pv - friction * sign) / mass;
    d.y = pw;
    d.w = hand_mass > 0 ? (hand_stiffness * (path(t, middle_) - py) +
                           hand_damping * (path_velocity(middle_) - pw) - fh) /
                              hand_mass
                        : 0;
    d.actuator = time_constant > 0 ? (force - pa) / time_constant : 0;
    d.work = acting(force, pa) * d.x;
    d.dissipation = damping * d.x * d.x + friction * std::abs(d.x);
    d.hand = fh * d.x;
    return d;
  }

  [[nodiscard]] Real net_at_rest(Real force) const {
    return hand_force(time, x, 0, y, w) - acting(force, actuator);
  }

  void runge_kutta(Real force, Real h) {
    const Real sign = friction > 0 ? (sticks ? 0 : sign_) : 0;
    const Derivative a = derive(time, x, v, y, w, actuator, force, sign);
    const auto at = [&](const Derivative& d, Real f) {
      return derive(time + f, x + f * d.x, v + f * d.v, y + f * d.y, w + f * d.w,
                    actuator + f * d.actuator, force, sign);
    };
    const Derivative b = at(a, h / 2);
    const Derivative c = at(b, h / 2);
    const Derivative d = at(c, h);
    const auto mean = [&](Real Derivative::*m) {
      return h * (a.*m + 2 * (b.*m) + 2 * (c.*m) + d.*m) / 6;
    };
    x += mean(&Derivative::x);
    v += mean(&Derivative::v);
    y += mean(&Derivative::y);
    w += mean(&Derivative::w);
    actuator += mean(&Derivative::actuator);
    actuator_work += mean(&Derivative::work);
    dissipation += mean(&Derivative::dissipation);
    hand_work += mean(&Derivative::hand);
    time += h;
  }

  // One small step; where the handle stops or breaks loose in its course, the step is cut at the
  // instant that a straight line between its ends gives.
  void small_step(Real force, Real h, int cuts_left = 4) {
    middle_ = time + h / 2;
    if (friction <= 0) return runge_kutta(force, h);
    if (sticks && std::abs(net_at_rest(force)) > friction) {
      sticks = false;
      sign_ = net_at_rest(force) > 0 ? 1 : -1;
      ++events;
    }
    const BruteForcePlant before = *this;
    runge_kutta(force, h);
    const Real reserve_before =
        before.sticks ? friction - std::abs(before.net_at_rest(force)) : before.v * sign_;
    const Real reserve_after = sticks ? friction - std::abs(net_at_rest(force)) : v * sign_;
    if (reserve_after >= 0 || cuts_left == 0) return;
    const Real cut = reserve_before > 0 ? h * reserve_before / (reserve_before - reserve_after) : 0;
    *this = before;
    if (cut > 0) runge_kutta(force, cut);
    if (sticks) {
      sticks = false;
      sign_ = net_at_rest(force) > 0 ? 1 : -1;
    } else {
      v = 0;
      sticks = true;
    }
    ++events;
    if (h > cut) small_step(force, h - cut, cuts_left - 1);
  }

  void advance(Real force, Real period, int steps) {
    const Real start = time;
    for (int i = 0; i < steps; ++i) {
      time = start + period * i / steps;
      small_step(force, period / steps);
    }
    time = start + period;
  }

 private:
  Real sign_ = 0;
  Real middle_ = 0;
};

}  // namespace hapticwall::testing
