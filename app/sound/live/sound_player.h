// The live sound: a thread between the loop's queue and the card.
#pragma once

#include <memory>
#include <thread>

#include "app/sound/live/card.h"
#include "app/sound/live/sound_pump.h"
#include "app/sound/live/sound_status.h"

namespace hapticwall::sound {

// All members are called from one thread, the owner's, and none waits for the card. The
// loop meets the sound only at SoundFeed.
class SoundPlayer {
 public:
  explicit SoundPlayer(OpenCard open_card);
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;
  // Silence. Waits for at most 0.2 s; a card that is stuck for longer keeps its thread.
  ~SoundPlayer();

  // Opens the card, or closes it. A card that did not open is tried again at the next switch.
  void play(bool on);
  void mix(const SoundMix& mix);
  // Selects the session to be heard; selecting the same one again costs nothing.
  void follow(const SoundSource& source);
  [[nodiscard]] SoundStatus status() const;

 private:
  struct Shared;
  static void work(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;  // shared with the thread, which may outlive the player
  std::thread thread_;
};

}  // namespace hapticwall::sound
