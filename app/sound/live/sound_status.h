// The state of the live sound, for people.
#pragma once

#include <cstdint>
#include <string>

namespace hapticwall::sound {

enum class SoundState : std::uint8_t { kOff, kOpening, kPlaying, kNoCard, kStuck };

struct SoundStatus {
  SoundState state = SoundState::kOff;
  std::string card;        // the card on which it plays
  std::string problem;     // reason of kNoCard
  double latency_s = 0.0;  // while it plays: from a tick to the plug
};

// One sentence.
[[nodiscard]] std::string describe(const SoundStatus& status);

}  // namespace hapticwall::sound
