// The amplitude spectrum of a signal.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

// Max samples that are transformed: of a longer range only the newest.
inline constexpr std::size_t kMaxSpectrumSamples = 16'384;
inline constexpr std::size_t kMinSpectrumSamples = 16;

// Amplitudes of sines in SI units, at multiples of `step_hz` from 0; empty for too few samples.
struct Spectrum {
  double step_hz = 0.0;
  std::vector<double> amplitude;
};

// Spectrum of the range without its mean, through a Hann window and with as many zeros as the next
// power of two needs: the amplitude of a sine is right to 15 % between two lines, and exact on one.
// Masked samples are the mean.
[[nodiscard]] Spectrum spectrum_of(const SampleHistory& history, Quantity quantity,
                                   IndexRange range);

struct SpectralLine {
  double frequency_hz = 0.0;
  double amplitude = 0.0;  // SI
};

// The strongest line, between two multiples by the parabola through the logarithms of three;
// nullopt without a line.
[[nodiscard]] std::optional<SpectralLine> strongest_line(const Spectrum& spectrum);

}  // namespace hapticwall::draw
