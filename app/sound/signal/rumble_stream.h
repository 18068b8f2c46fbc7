// From ticks to the two motors of a gamepad.
#pragma once

#include <array>
#include <cstddef>

#include "app/sound/signal/handle_sound.h"
#include "core/sample.h"

namespace hapticwall::sound {

// The strong motor has the band below, the weak one the band above.
inline constexpr double kRumbleSplitHz = 100.0;
// A weaker band counts as still: a motor hardly turns at a seventh of its range (see RumblePump).
inline constexpr double kRumbleStillShare = 0.02;

// Amplitude of a sine with the RMS of the band, in full scales of the sound: 0 to 1.
struct RumbleShares {
  double strong = 0.0;
  double weak = 0.0;
};

// Realtime-safe: yes, except the constructor.
class RumbleStream {
 public:
  RumbleStream(double loop_hz, bool knows_truth);

  void take(const Tick& tick);
  // Of the ticks since the last call.
  [[nodiscard]] RumbleShares read();

 private:
  using Stages = std::array<double, 2>;  // low-passes of first order, one after the other
  [[nodiscard]] double below_split(double value);
  [[nodiscard]] double above_split(double value);
  [[nodiscard]] double share(double squares) const;

  TickSound sound_;
  double smoothing_;  // of the filters
  Stages low_{};
  Stages high_{};
  double low_squares_ = 0.0;
  double high_squares_ = 0.0;
  std::size_t ticks_ = 0;
};

}  // namespace hapticwall::sound
