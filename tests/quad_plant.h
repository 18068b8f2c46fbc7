// The handle's motion over a step as a power series in a number of 113 bits: a reference for the
// last digit of the plant, also where eigenvalues coincide, which a power series does not notice.
// It shares nothing with the plant but the scene's numbers. Tests only; no friction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/scene.h"

namespace hapticwall::testing {

// On some machines long double is itself a quad.
#if defined(__SIZEOF_FLOAT128__)
__extension__ using Quad = __float128;
#else
using Quad = long double;
#endif

class QuadPlant {
 public:
  explicit QuadPlant(const Scene& scene) {
    const DeviceSettings& device = scene.x().device;
    mass_ = device.mass_kg;
    damping_ = device.damping_n_s_per_m;
    x = y = device.start_m;
    if (device.amplifier_time_constant_s.value_or(0.0) > 0.0) {
      lag_rate_ = 1 / static_cast<Quad>(*device.amplifier_time_constant_s);
    }
    if (!scene.x().hand) return;
    const HandSettings& hand = *scene.x().hand;
    hand_stiffness_ = hand.stiffness_n_per_m;
    hand_damping_ = hand.damping_n_s_per_m;
    grip_ = hand.has_grip();
    if (grip_) {
      hand_mass_ = *hand.mass_kg;
      grip_stiffness_ = *hand.grip_stiffness_n_per_m;
      grip_damping_ = hand.grip_damping_n_s_per_m.value_or(0.0);
    } else {
      mass_ += hand.mass_kg.value_or(0.0);
    }
  }

  // Advances by `duration` under a constant command, the hand's intention moving at constant speed.
  void advance(Quad force, Quad path, Quad speed, Quad duration) {
    const Quad rate = damping_ / mass_ + lag_rate_ +
                      (grip_ ? (grip_damping_ + hand_damping_) / hand_mass_ + grip_damping_ / mass_
                             : hand_damping_ / mass_);
    Quad square = (grip_ ? grip_stiffness_ : hand_stiffness_) / mass_;
    if (grip_) square += (grip_stiffness_ + hand_stiffness_) / hand_mass_;
    const double fastest = static_cast<double>(rate) + 2.0 * std::sqrt(static_cast<double>(square));
    constexpr double kReach = 0.5;
    const int steps =
        1 + static_cast<int>(std::ceil(static_cast<double>(duration) * fastest / kReach));
    const Quad h = duration / steps;
    for (int i = 0; i < steps; ++i) step(force, path + speed * (h * i), speed, h);
  }

  [[nodiscard]] Quad kinetic() const { return mass_ * v * v / 2; }

  Quad x = 0, v = 0, y = 0, w = 0, actuator = 0;
  Quad actuator_work = 0, dissipation = 0, hand_work = 0;

 private:
  static constexpr std::size_t kTerms = 40;
  using Series = std::array<Quad, kTerms>;  // terms of t^0, t^1, …, scaled by h^n

  static Quad sum(const Series& series) {
    Quad total = 0;
    for (auto term = series.rbegin(); term != series.rend(); ++term) total += *term;
    return total;
  }
  // ∫_0^h P Q.
  static Quad product(const Series& p, const Series& q, Quad h) {
    Quad total = 0;
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) total += p[i] * q[j] / static_cast<int>(i + j + 1);
    }
    return total * h;
  }

  void step(Quad force, Quad path, Quad speed, Quad h) {
    Series xs{}, vs{}, ys{}, ws{}, as{}, forces{};
    xs[0] = x;
    vs[0] = v;
    ys[0] = y;
    ws[0] = w;
    as[0] = lag_rate_ > 0 ? actuator : force;
    for (std::size_t n = 0; n < kTerms; ++n) {
      const Quad p = n == 0 ? path : n == 1 ? speed * h : 0;
      const Quad s = n == 0 ? speed : 0;
      const Quad by_hand = grip_ ? hand_stiffness_ * (p - ys[n]) + hand_damping_ * (s - ws[n])
                                 : hand_stiffness_ * (p - xs[n]) + hand_damping_ * (s - vs[n]);
      forces[n] =
          grip_ ? grip_stiffness_ * (ys[n] - xs[n]) + grip_damping_ * (ws[n] - vs[n]) : by_hand;
      if (n + 1 == kTerms) break;
      const Quad scale = h / static_cast<int>(n + 1);
      xs[n + 1] = scale * vs[n];
      vs[n + 1] = scale * (forces[n] - as[n] - damping_ * vs[n]) / mass_;
      ys[n + 1] = grip_ ? scale * ws[n] : xs[n + 1];
      if (grip_) ws[n + 1] = scale * (by_hand - forces[n]) / hand_mass_;
      const Quad command = n == 0 ? force : 0;
      if (lag_rate_ > 0) as[n + 1] = scale * lag_rate_ * (command - as[n]);
    }
    actuator_work += product(as, vs, h);
    dissipation += damping_ * product(vs, vs, h);
    hand_work += product(forces, vs, h);
    x = sum(xs);
    v = sum(vs);
    y = sum(ys);
    w = sum(ws);
    actuator = sum(as);
  }

  Quad mass_ = 1, damping_ = 0, hand_mass_ = 1, hand_stiffness_ = 0, hand_damping_ = 0;
  Quad grip_stiffness_ = 0, grip_damping_ = 0, lag_rate_ = 0;
  bool grip_ = false;
};

}  // namespace hapticwall::testing
