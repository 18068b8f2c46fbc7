// From ticks to a gamepad, without thread and clock.
#pragma once

#include <span>

#include "app/sound/live/sound_pump.h"
#include "app/sound/signal/rumble_stream.h"
#include "device/evdev/gamepad.h"

namespace hapticwall::sound {

// The gamepad gets new levels this far apart at least.
inline constexpr double kRumblePeriodS = 0.02;

class RumblePump {
 public:
  // `gamepad` outlives the pump.
  RumblePump(const SoundSource& source, device::evdev::Gamepad& gamepad);
  RumblePump(const RumblePump&) = delete;
  RumblePump& operator=(const RumblePump&) = delete;
  // Stops the motors.
  ~RumblePump();

  // Still while the mix is masked. The error is the gamepad's. Realtime-safe: no.
  [[nodiscard]] Failure step(std::span<const Tick> ticks, const SoundMix& mix);

 private:
  double loop_hz_;
  device::evdev::Gamepad& gamepad_;
  RumbleStream stream_;
  double elapsed_s_ = 0.0;
  device::evdev::RumbleLevels levels_;  // in force
};

}  // namespace hapticwall::sound
