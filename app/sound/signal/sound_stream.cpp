#include "app/sound/signal/sound_stream.h"

#include <cmath>

namespace hapticwall::sound {

double soft_limited(double value) {
  constexpr double kRest = 1.0 - kLinearShare;
  const double size = std::abs(value);
  if (size <= kLinearShare) return value;
  return std::copysign(kLinearShare + kRest * std::tanh((size - kLinearShare) / kRest), value);
}

SoundStream::SoundStream(double loop_hz, double card_hz, bool knows_truth)
    : loop_hz_(loop_hz), sound_(loop_hz, knows_truth), resampler_(loop_hz, card_hz) {}

void SoundStream::take(const Tick& tick, std::vector<float>& out) { push(sound_.next(tick), out); }

void SoundStream::finish(std::vector<float>& out) {
  const auto inputs = static_cast<int>(std::ceil(delay_s() * loop_hz_));
  for (int i = 0; i < inputs; ++i) push(0.0, out);
}

void SoundStream::push(double acceleration, std::vector<float>& out) {
  const std::size_t begin = out.size();
  resampler_.push(acceleration / kFullScaleMPerS2, out);
  for (std::size_t i = begin; i < out.size(); ++i)
    out[i] = static_cast<float>(soft_limited(static_cast<double>(out[i])));
}

}  // namespace hapticwall::sound
