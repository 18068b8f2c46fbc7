// From ticks to the card's ring, without thread and clock.
#pragma once

#include <span>
#include <vector>

#include "app/sound/live/card.h"
#include "app/sound/live/drift.h"
#include "app/sound/live/masking_noise.h"
#include "app/sound/live/sound_ring.h"
#include "app/sound/live/tick_taker.h"
#include "app/sound/signal/sound_stream.h"

namespace hapticwall::sound {

struct SoundMix {
  double volume = 0.5;  // 0 to 1
  bool masked = false;  // noise in the place of the signal
};

// The time that ticks and calls of the card may be late.
inline constexpr double kSpareS = 0.004;
// The pump's calls are this far apart.
inline constexpr double kPumpPeriodS = 0.001;

class SoundPump {
 public:
  // `ring` outlives the pump.
  SoundPump(const SoundSource& source, const CardFacts& card, SoundRing& ring);

  // Moves all ticks. Realtime-safe: no.
  void step(std::span<const Tick> ticks, const SoundMix& mix);

  // From a tick to the plug.
  [[nodiscard]] double latency_s() const;

 private:
  void mix_in(const SoundMix& mix);

  double loop_hz_;
  CardFacts card_;
  SoundRing& ring_;
  RingLevels levels_;
  SoundStream stream_;
  MaskingNoise noise_;
  DriftControl drift_;
  std::vector<float> samples_;
};

}  // namespace hapticwall::sound
