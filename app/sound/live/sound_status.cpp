#include "app/sound/live/sound_status.h"

#include <fmt/format.h>

#include "core/units.h"

namespace hapticwall::sound {

std::string describe(const SoundStatus& status) {
  switch (status.state) {
    case SoundState::kOff:
      return "The sound is off.";
    case SoundState::kOpening:
      return "The sound card is being opened.";
    case SoundState::kNoCard:
      return "There is no sound: " + status.problem + ".";
    case SoundState::kStuck:
      return "The sound card does not take samples: switch the sound off and on again.";
    case SoundState::kPlaying:
      break;
  }
  return fmt::format("{}: the sound is {:.0f} ms behind the handle.", status.card,
                     status.latency_s * kMillisecondsPerSecond);
}

}  // namespace hapticwall::sound
