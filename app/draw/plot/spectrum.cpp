#include "app/draw/plot/spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <kissfft/kissfft.hh>
#include <numbers>

namespace hapticwall::draw {
namespace {

// The windowed samples, and the sum of the window.
struct Windowed {
  std::vector<double> values;  // padded to a power of two
  double sum = 0.0;
};

Windowed windowed(const SampleHistory& history, Quantity quantity, IndexRange range) {
  Windowed result;
  const auto count = range.count();
  result.values.resize(std::bit_ceil(count));
  const double mean = history.stats(quantity, range).mean();
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double weight = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn);
    const double value = history.value(quantity, range.first + i) - mean;
    result.values[i] = std::isnan(value) ? 0.0 : weight * value;
    result.sum += weight;
  }
  return result;
}

}  // namespace

Spectrum spectrum_of(const SampleHistory& history, Quantity quantity, IndexRange range) {
  if (range.count() < kMinSpectrumSamples) return {};
  if (range.count() > kMaxSpectrumSamples) range.first = range.last - kMaxSpectrumSamples;
  const Windowed samples = windowed(history, quantity, range);
  const std::size_t half = samples.values.size() / 2;
  std::vector<std::complex<double>> lines(half);
  const kissfft<double> transform(half, false);
  transform.transform_real(samples.values.data(), lines.data());
  const double length_s =
      history.value(&Sample::time_s, range.last - 1) - history.value(&Sample::time_s, range.first);
  Spectrum spectrum;
  const double rate_hz = static_cast<double>(range.count() - 1) / length_s;
  spectrum.step_hz = rate_hz / static_cast<double>(samples.values.size());
  // The first holds the mean and the highest frequency, which have no sine.
  spectrum.amplitude.push_back(0.0);
  for (std::size_t i = 1; i < half; ++i)
    spectrum.amplitude.push_back(2.0 * std::abs(lines[i]) / samples.sum);
  return spectrum;
}

std::optional<SpectralLine> strongest_line(const Spectrum& spectrum) {
  const std::vector<double>& all = spectrum.amplitude;
  const auto strongest = std::max_element(all.begin(), all.end());
  if (strongest == all.end() || !(*strongest > 0.0)) return std::nullopt;
  const auto index = static_cast<double>(strongest - all.begin());
  SpectralLine line{index * spectrum.step_hz, *strongest};
  if (strongest - all.begin() < 2 || strongest + 1 == all.end()) return line;
  const double before = std::log(strongest[-1] / *strongest);
  const double after = std::log(strongest[1] / *strongest);
  const double curve = before + after;
  if (!(curve < 0.0) || !std::isfinite(curve)) return line;
  const double shift = 0.5 * (before - after) / curve;
  line.frequency_hz += shift * spectrum.step_hz;
  line.amplitude *= std::exp(-0.25 * (before - after) * shift);
  return line;
}

}  // namespace hapticwall::draw
