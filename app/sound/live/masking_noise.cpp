#include "app/sound/live/masking_noise.h"

#include <cmath>
#include <numbers>

namespace hapticwall::sound {
namespace {

constexpr double kFirstHz = 20.0;
constexpr double kStep = 4.0;  // from the corner of a part to the next
constexpr double kRms = 0.2;

}  // namespace

// Each part is white noise behind a low-pass; equal power of all gives a slope of 3 dB an octave.
MaskingNoise::MaskingNoise(double rate_hz) {
  double corner_hz = kFirstHz;
  for (Part& part : parts_) {
    part.share = 1.0 - std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz);
    // Variance of its output: share / (2 - share) of 1/3.
    part.gain = kRms * std::sqrt(3.0 * (2.0 - part.share) / part.share /
                                 static_cast<double>(parts_.size()));
    corner_hz *= kStep;
  }
}

double MaskingNoise::next() {
  double sum = 0.0;
  for (Part& part : parts_) {
    // Knuth's linear congruential generator; its upper bits are good enough to be heard.
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    const double white = static_cast<double>(state_ >> 11U) * 0x1p-52 - 1.0;
    part.value += part.share * (white - part.value);
    sum += part.gain * part.value;
  }
  return soft_limited(sum);
}

}  // namespace hapticwall::sound
