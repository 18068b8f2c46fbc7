// Resampler from the loop's rate to a sound card's, band-limited.
#pragma once

#include <cstddef>
#include <vector>

namespace hapticwall::sound {

// The pass band ends at 0.3 of this rate or of the input's, whichever is smaller; the stop band
// begins at half of it.
inline constexpr double kMaxBandHz = 10000.0 / 3.0;
inline constexpr double kKernelHalf = 10.0;  // length on either side of its middle, in 1/band

// A sinc under a Kaiser window, evaluated where the output needs it: any ratio, also one that
// changes. Images and aliases are 65 dB below the line that they come from, the pass band is flat
// to 0.01 dB. libsamplerate delays a loop of 1 kHz by 20 ms, this one by 10 ms, and refuses ratios
// above 256, as of a loop of 100 Hz. Costs 2 delay_s() * from_hz multiplications an output.
// Realtime-safe: push() is, where `out` has room.
class Resampler {
 public:
  // Precondition: both rates are more than 0; `to_hz` is at least kMaxBandHz.
  Resampler(double from_hz, double to_hz);

  // Takes an input and appends the outputs that it completes. The first output has the time of the
  // first input.
  void push(double input, std::vector<float>& out);

  // More (> 0) or less (< 0) input for each output, as a share of the ratio.
  void correct(double share) { step_ = ratio_ * (1.0 + share); }
  // Delay from an input to its output.
  [[nodiscard]] double delay_s() const { return kKernelHalf / band_hz_; }

 private:
  [[nodiscard]] double kernel(double inputs) const;
  [[nodiscard]] double output() const;

  double from_hz_;
  double band_hz_;
  double ratio_;  // inputs an output
  double step_;
  double half_;                // half length of the kernel, in inputs
  std::vector<double> table_;  // one half of the kernel
  std::vector<double> ring_;   // the last inputs
  std::size_t newest_ = 0;
  double next_;  // time of the next output after the newest input, in inputs; negative: before it
};

}  // namespace hapticwall::sound
