#include "app/sound/signal/rumble_stream.h"

#include <cmath>
#include <numbers>

#include "app/sound/signal/sound_stream.h"

namespace hapticwall::sound {

RumbleStream::RumbleStream(double loop_hz, bool knows_truth)
    : sound_(loop_hz, knows_truth),
      smoothing_(1.0 - std::exp(-2.0 * std::numbers::pi * kRumbleSplitHz / loop_hz)) {}

void RumbleStream::take(const Tick& tick) {
  const double value = sound_.next(tick) / kFullScaleMPerS2;
  low_squares_ += std::pow(below_split(value), 2.0);
  high_squares_ += std::pow(above_split(value), 2.0);
  ++ticks_;
}

RumbleShares RumbleStream::read() {
  const RumbleShares shares{share(low_squares_), share(high_squares_)};
  low_squares_ = high_squares_ = 0.0;
  ticks_ = 0;
  return shares;
}

double RumbleStream::below_split(double value) {
  for (double& stage : low_) value = stage += smoothing_ * (value - stage);
  return value;
}

double RumbleStream::above_split(double value) {
  for (double& stage : high_) value -= stage += smoothing_ * (value - stage);
  return value;
}

double RumbleStream::share(double squares) const {
  if (ticks_ == 0) return 0.0;
  const double amplitude = soft_limited(std::sqrt(2.0 * squares / static_cast<double>(ticks_)));
  return amplitude < kRumbleStillShare ? 0.0 : amplitude;
}

}  // namespace hapticwall::sound
