#include "app/sound/live/rumble_pump.h"

#include <cmath>
#include <limits>
#include <utility>

namespace hapticwall::sound {
namespace {

using device::evdev::RumbleLevels;

// The vibration of an unbalanced motor grows with the square of its speed.
std::uint16_t level_of(double vibration) {
  const double speed = std::sqrt(vibration);
  return static_cast<std::uint16_t>(std::lround(speed * std::numeric_limits<std::uint16_t>::max()));
}

}  // namespace

RumblePump::RumblePump(const SoundSource& source, device::evdev::Gamepad& gamepad)
    : loop_hz_(source.rate_hz), gamepad_(gamepad), stream_(loop_hz_, source.knows_truth) {}

RumblePump::~RumblePump() {
  if (levels_ != RumbleLevels{}) static_cast<void>(gamepad_.rumble({}));
}

// The last levels end by themselves when the loop stands still.
Failure RumblePump::step(std::span<const Tick> ticks, const SoundMix& mix) {
  for (const Tick& tick : ticks) stream_.take(tick);
  elapsed_s_ += static_cast<double>(ticks.size()) / loop_hz_;
  if (elapsed_s_ < kRumblePeriodS) return std::nullopt;
  elapsed_s_ = 0.0;
  const RumbleShares shares = stream_.read();
  const double volume = mix.masked ? 0.0 : mix.volume;
  const RumbleLevels next{level_of(volume * shares.strong), level_of(volume * shares.weak)};
  const RumbleLevels before = std::exchange(levels_, next);
  if (next == RumbleLevels{} && before == next) return std::nullopt;
  return gamepad_.rumble(next);
}

}  // namespace hapticwall::sound
