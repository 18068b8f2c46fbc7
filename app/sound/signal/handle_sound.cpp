#include "app/sound/signal/handle_sound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hapticwall::sound {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kMaxClickShare = 0.2;  // share of the loop's rate

bool is_unknown(const Sample& sample) {
  return (sample.flags & (kFlagDeviceFault | kFlagStaleInput)) != 0;
}

}  // namespace

HandleSound::HandleSound(double rate_hz, bool knows_truth)
    : rate_hz_(rate_hz),
      knows_truth_(knows_truth),
      low_cut_(std::exp(-kTurn * kLowestHz / rate_hz)),
      smoothing_(1.0 - std::exp(-kTurn * kMeasuredHighestHz / rate_hz)) {}

double HandleSound::next(const Sample& sample) {
  const double sum = band(acceleration(sample)) + click(sample);
  return std::isfinite(sum) ? sum : 0.0;
}

double HandleSound::acceleration(const Sample& sample) {
  const double velocity = knows_truth_ ? sample.truth.velocity_m_per_s : sample.velocity_m_per_s;
  const bool follows = has_velocity_ && sample.tick == tick_ + 1;
  const double change = velocity - velocity_m_per_s_;
  has_velocity_ = !is_unknown(sample) && std::isfinite(velocity);
  tick_ = sample.tick;
  velocity_m_per_s_ = velocity;
  return follows && has_velocity_ ? change * rate_hz_ : 0.0;
}

double HandleSound::band(double acceleration) {
  if (!knows_truth_) {
    for (double& stage : smoothed_) {
      stage += smoothing_ * (acceleration - stage);
      acceleration = stage;
    }
  }
  high_ = low_cut_ * high_ + 0.5 * (1.0 + low_cut_) * (acceleration - previous_);
  previous_ = acceleration;
  return high_;
}

double HandleSound::click(const Sample& sample) {
  const bool touches = (sample.flags & kFlagInContact) != 0;
  if (touches && free_s_ >= kFreeBeforeClickS && has_velocity_) {
    click_m_per_s2_ = kClickPerSpeed * std::abs(velocity_m_per_s_);
    click_phase_ = 0.0;
  }
  free_s_ = touches ? 0.0 : free_s_ + 1.0 / rate_hz_;
  const double value = click_m_per_s2_ * std::sin(click_phase_);
  click_phase_ += kTurn * std::min(kClickHz / rate_hz_, kMaxClickShare);
  click_m_per_s2_ *= std::exp(-1.0 / (kClickDecayS * rate_hz_));
  return value;
}

double TickSound::next(const Tick& tick) {
  double sum = 0.0;
  for (std::size_t i = 0; i < tick.count; ++i) sum += axes_[i].next(tick.axes[i]);
  return sum;
}

}  // namespace hapticwall::sound
