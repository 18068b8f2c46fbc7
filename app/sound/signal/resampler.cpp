#include "app/sound/signal/resampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hapticwall::sound {
namespace {

constexpr double kCutoff = 0.4;      // middle of pass and stop band, share of the band's rate
constexpr double kKaiserBeta = 6.2;  // 65 dB
constexpr double kPerUnit = 256.0;   // entries of the table in 1/band; between them it is linear

// Value at `t`, which is in 1/band.
double windowed_sinc(double t) {
  const double x = 2.0 * std::numbers::pi * kCutoff * t;
  const double sinc = t == 0.0 ? 1.0 : std::sin(x) / x;
  const double share = t / kKernelHalf;
  const double root = std::sqrt(std::max(0.0, 1.0 - share * share));
  const double window =
      std::cyl_bessel_i(0.0, kKaiserBeta * root) / std::cyl_bessel_i(0.0, kKaiserBeta);
  return 2.0 * kCutoff * sinc * window;
}

}  // namespace

Resampler::Resampler(double from_hz, double to_hz)
    : from_hz_(from_hz),
      band_hz_(std::min(from_hz, kMaxBandHz)),
      ratio_(from_hz / to_hz),
      step_(ratio_),
      half_(kKernelHalf * from_hz / band_hz_),
      table_(static_cast<std::size_t>(kKernelHalf * kPerUnit) + 2, 0.0),
      ring_(2 * static_cast<std::size_t>(std::ceil(half_ + std::max(ratio_, 1.0))) + 2, 0.0),
      next_(1.0) {
  const double gain = band_hz_ / from_hz;
  for (std::size_t i = 0; i + 1 < table_.size(); ++i)
    table_[i] = gain * windowed_sinc(static_cast<double>(i) / kPerUnit);
}

void Resampler::push(double input, std::vector<float>& out) {
  newest_ = newest_ + 1 == ring_.size() ? 0 : newest_ + 1;
  ring_[newest_] = input;
  next_ -= 1.0;
  for (; next_ <= -half_; next_ += step_) out.push_back(static_cast<float>(output()));
}

double Resampler::kernel(double inputs) const {
  const double place = std::abs(inputs) * (band_hz_ / from_hz_) * kPerUnit;
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= table_.size()) return 0.0;
  return std::lerp(table_[below], table_[below + 1], place - static_cast<double>(below));
}

double Resampler::output() const {
  const double last = std::min(std::floor(half_ - next_), static_cast<double>(ring_.size() - 1));
  double sum = 0.0;
  auto back = static_cast<std::size_t>(std::max(0.0, std::ceil(-half_ - next_)));
  for (; static_cast<double>(back) <= last; ++back) {
    const std::size_t place = newest_ >= back ? newest_ - back : newest_ + ring_.size() - back;
    sum += ring_[place] * kernel(static_cast<double>(back) + next_);
  }
  return sum;
}

}  // namespace hapticwall::sound
