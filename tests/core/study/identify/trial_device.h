// A device to identify, on a simulator that shares nothing with the model of the fit: Runge-Kutta
// with very many small steps. It can be what the model is not. Tests and the proof only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "core/study/identify/experiment.h"
#include "core/study/identify/identify.h"
#include "tests/brute_force_plant.h"

namespace hapticwall::testing {

struct TrialDevice {
  double mass_kg = 0.1, damping_n_s_per_m = 1.0, friction_n = 0.1, encoder_m = 30e-6,
         lag_s = 0.5e-3;
  std::size_t delay_ticks = 1;
  double force_limit_n = 2.0;  // of the experiment
  // Effects that the model does not have.
  double friction_difference_n = 0.0;  // between the directions; the model has this one
  double backlash_m = 0.0;
  double cogging_n = 0.0, cogging_pitch_m = 8e-3;
  double stribeck = 0.0, stribeck_m_per_s = 0.02;  // share of f_c that is added at rest
  double hand_stiffness_n_per_m = 0.0, hand_damping_n_s_per_m = 0.0;
  double noise_m = 0.0;                         // standard deviation, before the encoder
  double jitter_s = 0.0;                        // a tick is late by up to this
  double late_change = 0.0;                     // share of changes of the force, late by a tick
  double ripple = 0.0, ripple_pitch_m = 10e-3;  // share of the force, over the position
  std::uint32_t seed = 1;
};

class TrialSimulator {
 public:
  static constexpr double kPeriodS = 1e-3;

  explicit TrialSimulator(const TrialDevice& device) : device_(device), random_(device.seed) {
    const bool split = device.backlash_m > 0.0;
    plant_.mass = static_cast<Real>(split ? 0.4 * device.mass_kg : device.mass_kg);
    load_mass_ = split ? 0.6 * device.mass_kg : 0.0;
    plant_.damping = static_cast<Real>(device.damping_n_s_per_m);
    plant_.friction = static_cast<Real>(device.friction_n);
    plant_.time_constant = static_cast<Real>(device.lag_s);
    plant_.hand_stiffness = static_cast<Real>(device.hand_stiffness_n_per_m);
    plant_.hand_damping = static_cast<Real>(device.hand_damping_n_s_per_m);
    plant_.path_velocity = [](Real) { return Real{0}; };
    output_.delay = device.delay_ticks;
    const double wanted = device.lag_s > 0.0 ? std::ceil(4.0 * kPeriodS / device.lag_s) : 0.0;
    steps_ = static_cast<int>(std::clamp(wanted, split ? 100.0 : 20.0, 4000.0));
    const double start_m = 0.03 + share() * device.encoder_m;  // between two counts
    plant_.x = static_cast<Real>(start_m);
    load_m_ = start_m;
    plant_.path = [start_m](Real, Real) { return static_cast<Real>(start_m); };
    if (!special()) return;
    // More forces act as the hand of the plant does, without the lag.
    if (plant_.hand_stiffness == 0) plant_.hand_stiffness = 1;
    plant_.path = [this, start_m, hand = device.hand_stiffness_n_per_m > 0.0](Real, Real) {
      return (hand ? static_cast<Real>(start_m) : begin_m_) + more_n_ / plant_.hand_stiffness;
    };
  }

  TrialSimulator(const TrialSimulator&) = delete;
  TrialSimulator& operator=(const TrialSimulator&) = delete;

  [[nodiscard]] double position_m() {
    const double noise_m =
        device_.noise_m > 0.0 ? device_.noise_m * std::normal_distribution<>()(random_) : 0.0;
    const double x = static_cast<double>(plant_.x) + noise_m;
    return device_.encoder_m * std::round(x / device_.encoder_m);
  }
  void advance(double force_n) {
    const bool is_late = device_.late_change > 0.0 && force_n != wanted_n_ &&
                         taken_n_ == wanted_n_ && share() < device_.late_change;
    wanted_n_ = force_n;
    if (!is_late) taken_n_ = force_n;
    const Real force = output_.pass(static_cast<Real>(taken_n_));
    const int late = static_cast<int>(share() * device_.jitter_s / kPeriodS * steps_);
    const int steps = steps_ + late - late_;
    late_ = late;
    if (!special()) return plant_.advance(force, step() * static_cast<Real>(steps), steps);
    for (int i = 0; i < steps; ++i) special_step(force);
  }
  // Force that was taken in the last tick.
  [[nodiscard]] double taken_n() const { return taken_n_; }

 private:
  [[nodiscard]] double share() { return std::uniform_real_distribution<>()(random_); }
  [[nodiscard]] Real step() const { return static_cast<Real>(kPeriodS) / steps_; }
  [[nodiscard]] bool special() const {
    return device_.backlash_m > 0.0 || device_.cogging_n > 0.0 || device_.stribeck > 0.0 ||
           device_.ripple > 0.0 || device_.friction_difference_n != 0.0;
  }
  void special_step(Real force) {
    const auto x = static_cast<double>(plant_.x);
    const double v = std::abs(static_cast<double>(plant_.v));
    const double turn = 2.0 * std::numbers::pi;
    plant_.friction = static_cast<Real>(
        device_.friction_n * (1.0 + device_.stribeck * std::exp(-v / device_.stribeck_m_per_s)));
    const double factor = 1.0 + device_.ripple * std::sin(turn * x / device_.ripple_pitch_m);
    double more_n = device_.friction_difference_n / 2.0;
    more_n += device_.cogging_n * std::sin(turn * x / device_.cogging_pitch_m);
    if (load_mass_ > 0.0) more_n += load_force();
    more_n_ = static_cast<Real>(-more_n);
    begin_m_ = plant_.x;
    plant_.advance(force * static_cast<Real>(factor), step(), 1);
  }
  // A mass beyond a gap, on a stiff spring.
  [[nodiscard]] double load_force() {
    const double h = static_cast<double>(step());
    const double apart_m = static_cast<double>(plant_.x) - load_m_;
    const double gap_m = device_.backlash_m / 2.0;
    const double pressed_m = apart_m - std::clamp(apart_m, -gap_m, gap_m);
    double force_n = 0.0;
    if (pressed_m != 0.0) {
      force_n = 2e4 * pressed_m + 3.0 * (static_cast<double>(plant_.v) - load_m_per_s_);
    }
    load_m_per_s_ += h * force_n / load_mass_;
    load_m_ += h * load_m_per_s_;
    return force_n;
  }

  TrialDevice device_;
  std::mt19937 random_;
  BruteForcePlant plant_;
  BruteForceOutput output_;
  int steps_ = 20;
  int late_ = 0;
  double wanted_n_ = 0.0, taken_n_ = 0.0;
  Real more_n_ = 0, begin_m_ = 0;
  double load_mass_ = 0.0, load_m_ = 0.0, load_m_per_s_ = 0.0;
};

struct TrialRun {
  identify::Record record;
  identify::ExperimentFacts facts;
  std::vector<double> applied_n;  // that the device tells at each tick
};

// A whole experiment.
inline TrialRun run_trial(const TrialDevice& device, double duration_s = 25.0) {
  identify::ExperimentSettings settings;
  settings.force_limit_n = device.force_limit_n;
  settings.encoder_m = device.encoder_m;
  settings.duration_s = duration_s;
  settings.seed = device.seed;
  identify::Experiment experiment(settings);
  TrialSimulator simulator(device);
  TrialRun run;
  run.record.period_s = TrialSimulator::kPeriodS;
  run.record.encoder_m = device.encoder_m;
  while (experiment.facts().state == identify::ExperimentState::kRunning) {
    run.record.position_m.push_back(simulator.position_m());
    run.applied_n.push_back(simulator.taken_n());
    run.record.force_n.push_back(experiment.step(run.record.position_m.back()));
    simulator.advance(run.record.force_n.back());
  }
  run.facts = experiment.facts();
  return run;
}

// Mass 0.02 to 1 kg, damping 0.05 to 5 N s/m and encoder 5 to 300 µm evenly in their logarithms;
// friction 0 to 1 N, delay 0 to 5 ticks, lag 0 to 2 ms.
inline TrialDevice random_device(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const auto by_logarithm = [&](double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  };
  TrialDevice device;
  device.mass_kg = by_logarithm(0.02, 1.0);
  device.damping_n_s_per_m = by_logarithm(0.05, 5.0);
  device.friction_n = between(0.0, 1.0);
  device.encoder_m = by_logarithm(5e-6, 300e-6);
  device.delay_ticks = static_cast<std::size_t>(between(0.0, 6.0));
  device.lag_s = between(0.0, 2e-3);
  device.seed = seed;
  return device;
}

}  // namespace hapticwall::testing
