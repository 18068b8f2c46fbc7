// The least that a simulation of golden-soft must do: propagate the state and evaluate the wall.
// Written by hand, without ledger, metrics, encoder, options or algorithm: the peer that every row
// of the benchmark is a ratio to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/plant/propagator.h"
#include "core/scene.h"

namespace hapticwall::benchmark_loops {

// State after `ticks` ticks; position and velocity, so that nothing is optimised away.
struct BareState {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

class BareLoop {
 public:
  explicit BareLoop(const Scene& scene)
      : start_m_(scene.x().device.start_m),
        wall_m_(scene.x().walls.at(0).position_m),
        stiffness_(scene.x().walls.at(0).stiffness_n_per_m),
        limit_n_(scene.x().device.force_limit_n.value()),
        ticks_(scene.tick_count()) {
    const HandSettings& hand = scene.x().hand.value();
    const double mass = scene.x().device.mass_kg + hand.mass_kg.value_or(0.0);
    const double period = scene.sampling.period_s();
    ramp_ticks_ =
        static_cast<std::uint64_t>(std::lround(hand.path[1].time_s * scene.sampling.rate_hz));
    ramp_m_per_tick_ =
        (hand.path[1].position_m - hand.path[0].position_m) / static_cast<double>(ramp_ticks_);
    ramp_speed_ = ramp_m_per_tick_ * scene.sampling.rate_hz;
    // (x - p, v, s, F), time in seconds: one matrix exponential.
    SetupMatrix<4> generator = SetupMatrix<4>::Zero();
    generator(0, 1) = period;
    generator(0, 2) = -period;
    generator(1, 0) = -hand.stiffness_n_per_m / mass * period;
    generator(1, 1) =
        -(hand.damping_n_s_per_m + scene.x().device.damping_n_s_per_m) / mass * period;
    generator(1, 2) = hand.damping_n_s_per_m / mass * period;
    generator(1, 3) = -period / mass;
    const SetupMatrix<4> increment =
        make_propagators<4>(generator, std::array<SetupMatrix<4>, 0>{}, 0).front().increment;
    for (int i = 0; i < 4; ++i) {
      phi_x_[i] = static_cast<double>(increment(0, i));
      phi_v_[i] = static_cast<double>(increment(1, i));
    }
    phi_x_[2] += period;  // x itself, not x - p
  }

  [[nodiscard]] BareState run() const {
    double x = start_m_;
    double v = 0.0;
    double path = start_m_;
    for (std::uint64_t tick = 0; tick < ticks_; ++tick) {
      const bool ramp = tick < ramp_ticks_;
      const double s = ramp ? ramp_speed_ : 0.0;
      const double f = std::min(limit_n_, std::max(0.0, stiffness_ * (x - wall_m_)));
      const double q = x - path;
      const double dx = phi_x_[0] * q + phi_x_[1] * v + phi_x_[2] * s + phi_x_[3] * f;
      const double dv = phi_v_[0] * q + phi_v_[1] * v + phi_v_[2] * s + phi_v_[3] * f;
      x += dx;
      v += dv;
      path += ramp ? ramp_m_per_tick_ : 0.0;
    }
    return {x, v};
  }

 private:
  double start_m_;
  double wall_m_;
  double stiffness_;
  double limit_n_;
  std::uint64_t ticks_;
  std::uint64_t ramp_ticks_ = 0;
  double ramp_m_per_tick_ = 0.0;
  double ramp_speed_ = 0.0;
  double phi_x_[4] = {};
  double phi_v_[4] = {};
};

}  // namespace hapticwall::benchmark_loops
