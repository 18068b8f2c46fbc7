// The live sound and the rumble: a thread between the loop's queue, the card and a gamepad.
#pragma once

#include <memory>
#include <thread>

#include "app/sound/live/card.h"
#include "app/sound/live/sound_pump.h"
#include "app/sound/live/sound_status.h"
#include "device/evdev/gamepad.h"

namespace hapticwall::sound {

// All members are called from one thread, the owner's, and none waits for the card or the gamepad.
// The loop meets the sound only at SoundFeed.
class SoundPlayer {
 public:
  SoundPlayer(OpenCard open_card, device::evdev::OpenGamepad open_gamepad);
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;
  // Silence. Waits for at most 0.2 s; a card or gamepad that is stuck for longer keeps its thread.
  ~SoundPlayer();

  // Opens the card, or closes it. A card that did not open is tried again at the next switch.
  void play(bool on);
  // The same for a gamepad, with or without a card. One that is lost stays lost until then.
  void rumble(bool on);
  void mix(const SoundMix& mix);
  // The session to be heard from now on; the same one again costs nothing.
  void follow(const SoundSource& source);
  [[nodiscard]] SoundStatus status() const;
  [[nodiscard]] RumbleStatus rumble_status() const;

 private:
  struct Shared;
  static void work(const std::shared_ptr<Shared>& shared);
  void change(bool Shared::*wish, bool on);

  std::shared_ptr<Shared> shared_;  // with the thread, which may outlive the player
  std::thread thread_;
};

}  // namespace hapticwall::sound
