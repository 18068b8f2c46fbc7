// A sound card.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/result.h"

namespace hapticwall::sound {

struct CardFacts {
  std::string name;
  double rate_hz = 48000.0;
  std::size_t period_frames = 128;  // frames that one call requests
  double latency_s = 0.0;           // latency from the call to the plug, as the card reports it
};

// Closed by its destructor, which may wait for the card.
class Card {
 public:
  Card() = default;
  Card(const Card&) = delete;
  Card& operator=(const Card&) = delete;
  virtual ~Card() = default;
  [[nodiscard]] virtual CardFacts facts() const = 0;
};

// The card calls it from its own thread whenever it wants samples, within ±1.
using FillSound = std::function<void(std::span<float> samples)>;
// Opens a card and lets it play; may wait for the card. It calls `fill` until it is closed.
using OpenCard = std::function<Result<std::unique_ptr<Card>>(const FillSound& fill)>;

// The usual card of this machine, through ALSA or JACK. ALSA reaches PipeWire and PulseAudio, too.
[[nodiscard]] Result<std::unique_ptr<Card>> open_usual_card(const FillSound& fill);

// True if the kernel knows a card or a sound server runs; opens nothing. Realtime-safe: no.
[[nodiscard]] bool may_have_card();

}  // namespace hapticwall::sound
