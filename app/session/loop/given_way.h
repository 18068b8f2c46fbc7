// Distance that a handle moves against the full force. A force decelerates a mass: the distance
// that the lost kinetic energy explains does not count. Arithmetic only. Realtime-safe: yes, all of
// it.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace hapticwall::session {

// A handle may be pushed so far against the full force.
inline constexpr double kMaxGivenWayM = 0.008;
// A force needs this time to show in the speed.
inline constexpr double kMinGivenWayS = 0.015;
// Moves with the handle.
inline constexpr double kArmMassKg = 2.0;

class GivenWay {
 public:
  GivenWay(double mass_kg, double encoder_m)
      : mass_kg_(mass_kg + kArmMassKg), noise_m_per_s_(encoder_m / kSpeedS) {}

  // One tick. `force_n`: of the last command. `full_force`: it was the force limit, 1 out of the
  // wall, -1 into it; else 0. True if the handle gave way.
  [[nodiscard]] bool gives(double position_m, double force_n, double limit_n, int full_force,
                           double elapsed_s) {
    take_position(position_m, elapsed_s);
    take_force(force_n, limit_n, elapsed_s);
    const bool begins = std::exchange(pushed_, full_force) != full_force;
    const double along_m = position_m * full_force;
    if (full_force == 0 || begins || along_m < held_m_) {
      held_m_ = along_m;
      held_s_ = 0.0;
    }
    held_s_ += elapsed_s;
    const double speed = std::max(speed_m_per_s_ * sign_, 0.0);
    const double slow = std::max(speed - noise_m_per_s_, 0.0);
    const double lost_j =
        0.5 * mass_kg_ * std::max(first_m_per_s_ * first_m_per_s_ - slow * slow, 0.0);
    const double given_m = full_force == 0 ? 0.0 : along_m - held_m_ - lost_j / std::abs(force_n);
    // A handle at rest has no energy left to explain more.
    if (full_force != 0 && speed <= noise_m_per_s_) {
      first_m_per_s_ = 0.0;
      held_m_ = along_m - std::max(given_m, 0.0);
    }
    return held_s_ >= kMinGivenWayS && given_m > kMaxGivenWayM;
  }
  void forget() {
    known_ = false;
    pushed_ = sign_ = 0;
    speed_m_per_s_ = 0.0;
  }

 private:
  static constexpr double kSpeedS = 0.004;  // time constant of the speed
  static constexpr double kMemoryS = 0.02;
  static constexpr double kWeakShare = 0.25;  // share of the force limit

  void take_position(double position_m, double elapsed_s) {
    if (known_ && elapsed_s > 0.0) {
      const double weight = elapsed_s / (elapsed_s + kSpeedS);
      speed_m_per_s_ += weight * ((position_m - position_m_) / elapsed_s - speed_m_per_s_);
    }
    known_ = true;
    position_m_ = position_m;
  }
  // The speed that a force meets first; a weak one does not count. A report may be missing then, so
  // that a speed counts a little longer.
  void take_force(double force_n, double limit_n, double elapsed_s) {
    const int sign = (force_n > 0.0 ? 1 : 0) - (force_n < 0.0 ? 1 : 0);
    const bool weak = std::abs(force_n) < kWeakShare * limit_n;
    if (std::exchange(sign_, sign) == sign && !weak) return;
    const double along = sign == 0 ? std::abs(speed_m_per_s_) : speed_m_per_s_ * sign;
    const double before = first_m_per_s_ * std::max(0.0, 1.0 - elapsed_s / kMemoryS);
    first_m_per_s_ = std::max({along + noise_m_per_s_, noise_m_per_s_, before});
  }

  double mass_kg_;
  double noise_m_per_s_;
  bool known_ = false;
  double position_m_ = 0.0;
  double speed_m_per_s_ = 0.0;
  int sign_ = 0;                // sign of the last force
  double first_m_per_s_ = 0.0;  // against the force; 0 after a rest
  int pushed_ = 0;              // the last full_force
  // The farthest that the present full force has pushed, along it, and the way from there that is
  // explained.
  double held_m_ = 0.0;
  double held_s_ = 0.0;  // since then
};

}  // namespace hapticwall::session
