// Audio samples from ticks, for files and sound cards alike.
#pragma once

#include <vector>

#include "app/sound/signal/handle_sound.h"
#include "app/sound/signal/resampler.h"
#include "core/sample.h"

namespace hapticwall::sound {

// The gain is fixed: quiet and loud runs can be compared.
inline constexpr double kFullScaleMPerS2 = 200.0;
// Linear up to this share of full scale, then bent so that full scale is never reached.
inline constexpr double kLinearShare = 0.75;

// `value` in full scales; the result is within ±1. Smooth, monotonic. Realtime-safe: yes.
[[nodiscard]] double soft_limited(double value);

// One channel; the accelerations of two axes are added. Realtime-safe: as Resampler::push().
class SoundStream {
 public:
  SoundStream(double loop_hz, double card_hz, bool knows_truth);

  // Appends samples within ±1.
  void take(const Tick& tick, std::vector<float>& out);
  // Appends the rest of a file: the samples that are still in the filter.
  void finish(std::vector<float>& out);

  void correct(double share) { resampler_.correct(share); }
  [[nodiscard]] double delay_s() const { return resampler_.delay_s(); }

 private:
  void push(double acceleration, std::vector<float>& out);

  double loop_hz_;
  TickSound sound_;
  Resampler resampler_;
};

}  // namespace hapticwall::sound
