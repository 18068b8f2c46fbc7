// How far a handle moves against the full force. A force slows a mass down: the way that the lost
// kinetic energy explains is no way given. Arithmetic only. Realtime-safe: yes, all of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace hapticwall::runtime {

// A handle may be pushed so far against the full force.
inline constexpr double kMaxGivenWayM = 0.008;
// A force needs this time to show in the speed.
inline constexpr double kMinGivenWayS = 0.01;
// Moves with the handle.
inline constexpr double kArmMassKg = 2.0;

class GivenWay {
 public:
  explicit GivenWay(double mass_kg, double encoder_m)
      : mass_kg_(mass_kg + kArmMassKg), noise_m_per_s_(encoder_m / kSpeedS) {}

  // One tick. `full_force`: the last command was the force limit, 1 out of the wall, -1 into it;
  // else 0. True if the handle gave way.
  [[nodiscard]] bool gives(double position_m, int full_force, double force_n, double elapsed_s) {
    if (elapsed_s > 0.0 && known_) {
      const double weight = elapsed_s / (elapsed_s + kSpeedS);
      speed_m_per_s_ += weight * ((position_m - position_m_) / elapsed_s - speed_m_per_s_);
    }
    known_ = true;
    position_m_ = position_m;
    const bool begins = std::exchange(pushed_, full_force) != full_force;
    if (full_force == 0) return false;
    const double along_m = position_m * full_force;
    const double speed = std::max(speed_m_per_s_ * full_force, 0.0);
    if (begins || along_m < held_m_) {
      held_m_ = along_m;
      held_s_ = 0.0;
      fastest_m_per_s_ = speed + noise_m_per_s_;
      return false;
    }
    held_s_ += elapsed_s;
    const double slow = std::max(speed - noise_m_per_s_, 0.0);
    const double lost_j =
        0.5 * mass_kg_ * std::max(fastest_m_per_s_ * fastest_m_per_s_ - slow * slow, 0.0);
    return held_s_ >= kMinGivenWayS && along_m - held_m_ > kMaxGivenWayM + lost_j / std::abs(force_n);
  }
  void forget() {
    known_ = false;
    pushed_ = 0;
    speed_m_per_s_ = 0.0;
  }

 private:
  static constexpr double kSpeedS = 0.004;  // of the mean speed

  double mass_kg_;
  double noise_m_per_s_;
  bool known_ = false;
  double position_m_ = 0.0;
  double speed_m_per_s_ = 0.0;
  int pushed_ = 0;        // the last full_force
  double held_m_ = 0.0;   // the farthest that the present full force has pushed, along it
  double held_s_ = 0.0;   // since then
  double fastest_m_per_s_ = 0.0;  // against the force, then
};

}  // namespace hapticwall::runtime
