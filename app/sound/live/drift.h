// Keeps a queue between two clocks at its level: a slow PI controller.
#pragma once

#include <algorithm>

namespace hapticwall::sound {

inline constexpr double kMaxCorrection = 0.005;  // of the ratio of the two rates
inline constexpr double kDriftPole = 0.5;        // 1/s, of both poles of the closed loop
inline constexpr double kDriftSmoothingS = 0.3;  // the level moves with every call of the card

// Realtime-safe: yes.
class DriftControl {
 public:
  // `excess_s`: what the queue holds above its level. Returns the share by which the reader should
  // be faster, within ±kMaxCorrection.
  double update(double excess_s, double elapsed_s) {
    const double weight = std::min(1.0, elapsed_s / kDriftSmoothingS);
    excess_s_ += weight * (excess_s - excess_s_);
    sum_ += kDriftPole * kDriftPole * excess_s_ * elapsed_s;
    sum_ = std::clamp(sum_, -kMaxCorrection, kMaxCorrection);
    return std::clamp(2.0 * kDriftPole * excess_s_ + sum_, -kMaxCorrection, kMaxCorrection);
  }
  [[nodiscard]] double excess_s() const { return excess_s_; }

 private:
  double excess_s_ = 0.0;
  double sum_ = 0.0;
};

}  // namespace hapticwall::sound
