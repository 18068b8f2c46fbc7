// The controller alone, moved by hand: a test names positions (or lets the present force choose
// them) and gets the ticks' samples. Tests only.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "core/tick/servo.h"

namespace hapticwall::testing {

inline void set_parameter(AlgorithmSettings& settings, std::string_view key, double value) {
  settings.values.at(find_algorithm_parameter(key).value()) = value;
}

// b/T: validate() takes no more for storage_stiffness_n_per_m.
inline double max_storage_stiffness(const ServoSettings& settings) {
  const AlgorithmContext context = algorithm_context(settings);
  return believed_damping(context) / context.period_s;
}

class PositionBench {
 public:
  explicit PositionBench(const ServoSettings& settings) : servo_(settings) {}

  Sample move_to(double position_m) {
    device_.reading.position_m = position_m;
    return servo_.tick(device_);
  }
  void reset() { servo_.reset(); }
  [[nodiscard]] Servo& servo() { return servo_; }

 private:
  struct Device {
    DeviceReading reading;
    DeviceReading read() const { return reading; }
    void write(double /*force_n*/) {}
  };

  Servo servo_;
  Device device_;
};

// Positions that are hard on an algorithm: rests, single counts, jumps through the wall and back,
// the surface itself, moves too small for a difference, long pushes, and the retreat that costs
// most at the force that was last commanded.
class Adversary {
 public:
  Adversary(std::uint64_t seed, const ServoSettings& settings)
      : random_(seed), settings_(settings) {
    if (!settings.walls.empty()) wall_m_ = settings.walls.walls().front().position_m;
    position_m_ = wall_m_ - 1e-3;
  }

  [[nodiscard]] double next(double force_n) {
    position_m_ = measured(position_m_ + move(force_n));
    if (!(std::abs(position_m_ - wall_m_) < kReachM)) position_m_ = measured(wall_m_);
    return position_m_;
  }

 private:
  static constexpr double kReachM = 0.1;

  [[nodiscard]] double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] double measured(double x) const {
    return settings_.encoder_m > 0.0 ? settings_.encoder_m * std::rint(x / settings_.encoder_m) : x;
  }
  [[nodiscard]] double move(double force_n) {
    if (pushes_left_ > 0) {
      --pushes_left_;
      return push_m_;
    }
    const double count_m = settings_.encoder_m > 0.0 ? settings_.encoder_m : 1e-4;
    switch (std::uniform_int_distribution<int>(0, 9)(random_)) {
      case 0:
      case 1:
        return 0.0;
      case 2:
        return count_m;
      case 3:
        return -count_m;
      case 4:
        return uniform(-5e-3, 5e-3);
      case 5:  // E falls by F² T/(4b)
        return -force_n / (2.0 * settings_.device_damping_n_s_per_m * settings_.rate_hz);
      case 6:
        return wall_m_ - position_m_;
      case 7:
        return std::ldexp(uniform(-1.0, 1.0), -60);
      case 8:
        pushes_left_ = 20;
        push_m_ = uniform(-2e-4, 4e-4);
        return push_m_;
      default:
        return wall_m_ + uniform(-1e-3, 3e-3) - position_m_;
    }
  }

  std::mt19937_64 random_;
  ServoSettings settings_;
  double wall_m_ = 0.0;
  double position_m_ = 0.0;
  double push_m_ = 0.0;
  int pushes_left_ = 0;
};

// `ticks` of the adversary against `settings`.
inline std::vector<Sample> attack(const ServoSettings& settings, std::uint64_t seed,
                                  std::size_t ticks) {
  PositionBench bench(settings);
  Adversary adversary(seed, settings);
  std::vector<Sample> rows;
  double force_n = 0.0;
  while (rows.size() < ticks) {
    rows.push_back(bench.move_to(adversary.next(force_n)));
    force_n = rows.back().force_n;
  }
  return rows;
}

}  // namespace hapticwall::testing
