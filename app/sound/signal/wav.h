// WAV files in memory.
#pragma once

#include <span>
#include <string>

#include "core/result.h"

namespace hapticwall::sound {

inline constexpr int kFileRateHz = 48000;

// The bytes of a file with one channel of 24 bits at kFileRateHz. Samples within ±1. Realtime-safe:
// no.
[[nodiscard]] Result<std::string> encode_wav(std::span<const float> samples);

}  // namespace hapticwall::sound
