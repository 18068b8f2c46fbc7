// What the ticks go to: a card, a gamepad, both or none. Without thread and clock.
#pragma once

#include <memory>
#include <optional>

#include "app/sound/live/card.h"
#include "app/sound/live/rumble_pump.h"
#include "app/sound/live/sound_pump.h"
#include "app/sound/live/tick_taker.h"
#include "device/evdev/gamepad.h"

namespace hapticwall::sound {

// Its functions may wait for card or gamepad.
class SoundOutputs {
 public:
  explicit SoundOutputs(std::shared_ptr<SoundRing> ring) : ring_(std::move(ring)) {}

  // After each of these, follow() the source anew.
  [[nodiscard]] Failure open_card(const OpenCard& open);
  void close_card();
  [[nodiscard]] Failure open_gamepad(const device::evdev::OpenGamepad& open);
  void close_gamepad();
  // Drops what waits in its feed.
  void follow(const SoundSource& source);

  // Moves all ticks. An error is the gamepad's, which is closed then.
  [[nodiscard]] Failure step(const SoundMix& mix);

  [[nodiscard]] const Card* card() const { return card_.get(); }
  [[nodiscard]] const device::evdev::Gamepad* gamepad() const { return gamepad_.get(); }
  [[nodiscard]] bool any() const { return card_ || gamepad_; }
  // 0 without a card or a source.
  [[nodiscard]] double latency_s() const { return pump_ ? pump_->latency_s() : 0.0; }

 private:
  std::shared_ptr<SoundRing> ring_;
  std::unique_ptr<Card> card_;
  std::unique_ptr<device::evdev::Gamepad> gamepad_;
  std::optional<TickTaker> taker_;
  std::optional<SoundPump> pump_;
  std::optional<RumblePump> rumble_;  // stops the motors, so it ends before the gamepad
};

}  // namespace hapticwall::sound
