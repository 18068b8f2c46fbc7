// The discrete Fourier transform at single frequencies, under a Hann window.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace hapticwall::test {

// Under a Hann window that keeps the amplitudes of lines.
template <typename Number>
std::vector<double> windowed(std::span<const Number> signal) {
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(signal.size());
  std::vector<double> result;
  for (const Number value : signal) {
    const double share = 1.0 - std::cos(turn * static_cast<double>(result.size()));
    result.push_back(static_cast<double>(value) * share);
  }
  return result;
}

// Amplitude of a line in a windowed signal, by Goertzel's recurrence.
inline double windowed_line(const std::vector<double>& signal, double rate_hz, double hz) {
  const double twice_cosine = 2.0 * std::cos(2.0 * std::numbers::pi * hz / rate_hz);
  double newest = 0.0;
  double older = 0.0;
  for (const double value : signal) {
    const double next = value + twice_cosine * newest - older;
    older = newest;
    newest = next;
  }
  const double power = newest * newest + older * older - twice_cosine * newest * older;
  return 2.0 * std::sqrt(std::max(power, 0.0)) / static_cast<double>(signal.size());
}

// Amplitude of the line at `hz`; 1 for a sine of amplitude 1.
template <typename Number>
double line_at(std::span<const Number> signal, double rate_hz, double hz) {
  return windowed_line(windowed(signal), rate_hz, hz);
}

struct Line {
  double hz = 0.0;
  double amplitude = 0.0;
};

// The strongest line from `from_hz` to `to_hz`, on a grid of `step_hz`.
template <typename Number>
Line strongest_line(std::span<const Number> signal, double rate_hz, double from_hz, double to_hz,
                    double step_hz) {
  const std::vector<double> under_window = windowed(signal);
  Line best;
  for (double hz = from_hz; hz <= to_hz; hz += step_hz) {
    const double amplitude = windowed_line(under_window, rate_hz, hz);
    if (amplitude > best.amplitude) best = {hz, amplitude};
  }
  return best;
}

template <typename Number>
double rms(std::span<const Number> signal) {
  double sum = 0.0;
  for (const Number value : signal) sum += static_cast<double>(value) * static_cast<double>(value);
  return std::sqrt(sum / static_cast<double>(signal.size()));
}

inline double decibels(double ratio) { return 20.0 * std::log10(ratio); }

}  // namespace hapticwall::test
