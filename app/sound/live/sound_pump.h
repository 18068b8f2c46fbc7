// From the loop's queue to the card's ring, without thread and clock.
#pragma once

#include <memory>
#include <vector>

#include "app/runtime/loop/sound_feed.h"
#include "app/sound/live/card.h"
#include "app/sound/live/drift.h"
#include "app/sound/live/masking_noise.h"
#include "app/sound/live/sound_ring.h"
#include "app/sound/signal/sound_stream.h"

namespace hapticwall::sound {

// A session that can be heard.
struct SoundSource {
  std::shared_ptr<runtime::SoundFeed> feed;  // null: none
  double rate_hz = 1000.0;
  bool knows_truth = true;
};

struct SoundMix {
  double volume = 0.5;  // 0 to 1
  bool masked = false;  // noise in the place of the signal
};

// The time that ticks and calls of the card may be late.
inline constexpr double kSpareS = 0.004;
// The pump's calls are this far apart.
inline constexpr double kPumpPeriodS = 0.001;
// Older ticks are dropped.
inline constexpr double kMaxBacklogS = 0.05;

class SoundPump {
 public:
  // Drops what waits in the feed. `ring` outlives the pump.
  SoundPump(SoundSource source, const CardFacts& card, SoundRing& ring);

  // Moves all ticks. Realtime-safe: no.
  void step(const SoundMix& mix);

  // From a tick to the plug.
  [[nodiscard]] double latency_s() const;

 private:
  [[nodiscard]] std::size_t take_ticks();
  void mix_in(const SoundMix& mix);

  SoundSource source_;
  CardFacts card_;
  SoundRing& ring_;
  RingLevels levels_;
  SoundStream stream_;
  MaskingNoise noise_;
  DriftControl drift_;
  std::vector<float> samples_;
};

}  // namespace hapticwall::sound
