// The signal of a voice coil on the handle: its acceleration, with a click at the touch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/sample.h"

namespace hapticwall::sound {

// Below this frequency the signal falls by 6 dB an octave: it has no constant part.
inline constexpr double kLowestHz = 20.0;
// Two first-order low-passes limit the acceleration of a measured position, which has the encoder's
// steps differentiated twice.
inline constexpr double kMeasuredHighestHz = 100.0;
// A touch after less time out of contact has no click: a limit cycle sounds by its acceleration.
inline constexpr double kFreeBeforeClickS = 0.03;
inline constexpr double kClickHz = 200.0;        // at most a fifth of the loop's rate
inline constexpr double kClickDecayS = 0.008;    // decay time to 1/e
inline constexpr double kClickPerSpeed = 200.0;  // 1/s: m/s² of its envelope per m/s of approach

// One axis, tick by tick. The acceleration is the mean over the last tick, (v(k) - v(k-1)) / T. `v`
// is the true velocity of a simulator's handle, or the measured one of a device. A lost tick, a
// fault, an old position and a number that is not finite count as no acceleration. Realtime-safe:
// yes.
class HandleSound {
 public:
  // `rate_hz`: of the loop, more than 0. `knows_truth`: the samples come from a simulator.
  HandleSound(double rate_hz, bool knows_truth);

  // Next value of the sound, in m/s².
  [[nodiscard]] double next(const Sample& sample);

 private:
  [[nodiscard]] double acceleration(const Sample& sample);
  [[nodiscard]] double band(double acceleration);
  [[nodiscard]] double click(const Sample& sample);

  double rate_hz_;
  bool knows_truth_;
  double low_cut_;  // coefficients of the filters
  double smoothing_;
  std::array<double, 2> smoothed_{};
  double previous_ = 0.0;  // input of the high-pass
  double high_ = 0.0;

  bool has_velocity_ = false;
  double velocity_m_per_s_ = 0.0;
  std::uint64_t tick_ = 0;

  double free_s_ = kFreeBeforeClickS;  // out of contact
  double click_m_per_s2_ = 0.0;        // envelope
  double click_phase_ = 0.0;
};

// The sum of a tick's axes. Realtime-safe: as HandleSound.
class TickSound {
 public:
  TickSound(double rate_hz, bool knows_truth)
      : axes_(kMaxAxes, HandleSound(rate_hz, knows_truth)) {}

  // Next value of the sound, in m/s².
  [[nodiscard]] double next(const Tick& tick);

 private:
  std::vector<HandleSound> axes_;
};

}  // namespace hapticwall::sound
