// How the live sound and the rumble fare, for people.
#pragma once

#include <cstdint>
#include <string>

namespace hapticwall::sound {

enum class SoundState : std::uint8_t { kOff, kOpening, kPlaying, kNoCard, kStuck };

struct SoundStatus {
  SoundState state = SoundState::kOff;
  std::string card;        // where it plays
  std::string problem;     // of kNoCard
  double latency_s = 0.0;  // where it plays: from a tick to the plug
};

enum class RumbleState : std::uint8_t { kOff, kOn, kNoGamepad };

struct RumbleStatus {
  RumbleState state = RumbleState::kOff;
  std::string gamepad;  // that rumbles
  std::string problem;  // of kNoGamepad
};

// One sentence.
[[nodiscard]] std::string describe(const SoundStatus& status);
[[nodiscard]] std::string describe(const RumbleStatus& status);

}  // namespace hapticwall::sound
