#include "app/sound/live/sound_outputs.h"

#include <span>
#include <utility>

namespace hapticwall::sound {

Failure SoundOutputs::open_card(const OpenCard& open) {
  Result<std::unique_ptr<Card>> card =
      open([ring = ring_](std::span<float> samples) { ring->fill(samples); });
  if (!card) return card.error();
  card_ = std::move(*card);
  return std::nullopt;
}

void SoundOutputs::close_card() {
  pump_.reset();
  card_.reset();
}

Failure SoundOutputs::open_gamepad(const device::evdev::OpenGamepad& open) {
  Result<std::unique_ptr<device::evdev::Gamepad>> gamepad = open();
  if (!gamepad) return gamepad.error();
  gamepad_ = std::move(*gamepad);
  return std::nullopt;
}

void SoundOutputs::close_gamepad() {
  rumble_.reset();
  gamepad_.reset();
}

void SoundOutputs::follow(const SoundSource& source) {
  taker_.reset();
  pump_.reset();
  rumble_.reset();
  if (!source.feed || !any()) return;
  taker_.emplace(source);
  if (card_) pump_.emplace(source, card_->facts(), *ring_);
  if (gamepad_) rumble_.emplace(source, *gamepad_);
}

Failure SoundOutputs::step(const SoundMix& mix) {
  if (!taker_) return std::nullopt;
  const std::span<const Tick> ticks = taker_->take();
  if (pump_) pump_->step(ticks, mix);
  Failure lost = rumble_ ? rumble_->step(ticks, mix) : std::nullopt;
  if (lost) close_gamepad();
  return lost;
}

}  // namespace hapticwall::sound
