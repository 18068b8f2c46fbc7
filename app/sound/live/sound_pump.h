// Transfer from ticks to the card's ring, without thread and clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/session/loop/sound_feed.h"
#include "app/sound/live/card.h"
#include "app/sound/live/sound_ring.h"
#include "app/sound/signal/sound_stream.h"
#include "core/sample.h"

namespace hapticwall::sound {

// A session that can be heard.
struct SoundSource {
  std::shared_ptr<session::SoundFeed> feed;  // null: none
  double rate_hz = 1000.0;
  bool knows_truth = true;
};

// Older ticks are dropped.
inline constexpr double kMaxBacklogS = 0.05;

// The ticks that wait for the sound.
class TickTaker {
 public:
  // Drops the ticks that wait in the feed. Precondition: the feed is not null.
  explicit TickTaker(const SoundSource& source);

  // All waiting ticks; empty if they waited too long. Valid until the next call. Realtime-safe: no.
  [[nodiscard]] std::span<const Tick> take();

 private:
  std::shared_ptr<session::SoundFeed> feed_;
  double max_backlog_;  // ticks
  std::vector<Tick> ticks_;
};

struct SoundMix {
  double volume = 0.5;  // 0 to 1
  bool masked = false;  // true: noise replaces the signal
};

// The time that ticks and calls of the card may be late.
inline constexpr double kSpareS = 0.004;
// The pump's calls are this far apart.
inline constexpr double kPumpPeriodS = 0.001;

inline constexpr double kMaxCorrection = 0.005;  // relative, of the ratio of the two rates
inline constexpr double kDriftPole = 0.5;        // 1/s, of both poles of the closed loop
inline constexpr double kDriftSmoothingS = 0.3;  // the level moves with every call of the card

// Keeps a queue between two clocks at its level: a slow PI controller. Realtime-safe: yes.
class DriftControl {
 public:
  // `excess_s`: content of the queue above its level. Returns the share by which the reader should
  // be faster, within ±kMaxCorrection.
  double update(double excess_s, double elapsed_s) {
    const double weight = std::min(1.0, elapsed_s / kDriftSmoothingS);
    excess_s_ += weight * (excess_s - excess_s_);
    sum_ += kDriftPole * kDriftPole * excess_s_ * elapsed_s;
    sum_ = std::clamp(sum_, -kMaxCorrection, kMaxCorrection);
    return std::clamp(2.0 * kDriftPole * excess_s_ + sum_, -kMaxCorrection, kMaxCorrection);
  }
  [[nodiscard]] double excess_s() const { return excess_s_; }

 private:
  double excess_s_ = 0.0;
  double sum_ = 0.0;
};

// Noise that falls by about 3 dB an octave over the band of the sound. It is independent of the
// loop. Realtime-safe: yes.
class MaskingNoise {
 public:
  explicit MaskingNoise(double rate_hz);
  // Within ±1, 0.2 RMS.
  [[nodiscard]] double next();

 private:
  struct Part {
    double share;  // share of the input that the part takes
    double gain;
    double value = 0.0;
  };
  std::array<Part, 4> parts_;
  std::uint64_t state_ = 1;
};

class SoundPump {
 public:
  // `ring` outlives the pump.
  SoundPump(const SoundSource& source, const CardFacts& card, SoundRing& ring);

  // Moves all ticks. Realtime-safe: no.
  void step(std::span<const Tick> ticks, const SoundMix& mix);

  // Latency from a tick to the plug.
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
