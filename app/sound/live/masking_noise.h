// Noise that falls by about 3 dB an octave over the band of the sound. It knows nothing of the
// loop.
#pragma once

#include <array>
#include <cstdint>

#include "app/sound/signal/sound_stream.h"

namespace hapticwall::sound {

// Realtime-safe: yes.
class MaskingNoise {
 public:
  explicit MaskingNoise(double rate_hz);
  // Within ±1, 0.2 RMS.
  [[nodiscard]] double next();

 private:
  struct Part {
    double share;  // of the input that it takes
    double gain;
    double value = 0.0;
  };
  std::array<Part, 4> parts_;
  std::uint64_t state_ = 1;
};

}  // namespace hapticwall::sound
