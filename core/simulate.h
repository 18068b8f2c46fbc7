// A whole scene on the built-in simulator, as fast as the machine can: no clock, no thread, no
// file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

// A change of what a live session lets its user change, in force from `tick` on: all of `scene` but
// the sampling rate, the hand's path, the start and the duration, which stay the first scene's. The
// handle goes on from where it is.
struct ScheduledChange {
  std::uint64_t tick = 0;
  Scene scene;
};

struct SimulationOptions {
  // Called once a tick with the tick's sample, in order; empty: samples are not even assembled.
  std::function<void(const Sample&)> on_sample;
  // Asked about every thousand ticks; true ends the run early, in good order (Ctrl-C).
  std::function<bool()> should_stop;
  // Sorted by tick.
  std::span<const ScheduledChange> changes;
};

struct SimulationResult {
  Summary summary;
  bool stopped_early = false;
  Sample final_state;  // at t = ticks * T: true state and energies, no force
};

// Runs a validated scene (validate(scene) gives nothing; a hand that follows the mouse is a
// precondition violated and throws std::invalid_argument). Deterministic: same scene, same bits.
// Realtime-safe: no (allocates at set-up, never in the loop).
[[nodiscard]] SimulationResult simulate(const Scene& scene, const SimulationOptions& options = {});

struct AxesOptions {
  // Called once a tick with the samples of both axes, in order; empty: they are not even assembled.
  std::function<void(const Sample& x, const Sample& y)> on_samples;
  std::function<bool()> should_stop;         // as in SimulationOptions
  std::span<const ScheduledChange> changes;  // of scenes with both axes, sorted by tick
};

struct AxesResult {
  SimulationResult x;
  SimulationResult y;
};

// Both axes of a corner, each as simulate() would run it alone: they share nothing but the clock.
// Where one diverges both end with it, the other at most kAxesApartTicks later.
// Preconditions: as those of simulate(), and scene.y. Realtime-safe: no.
[[nodiscard]] AxesResult simulate_axes(const Scene& scene, const AxesOptions& options = {});
inline constexpr std::uint64_t kAxesApartTicks = 1024;

// The same closed loop with the exact integrator, whatever the scene names, and the plant in
// extended precision (long double, 64 bits of mantissa); the controller is a digital computer and
// computes in double as ever. Samples and summary are rounded to double. The reference against
// which integrators are measured; several times slower.
[[nodiscard]] SimulationResult simulate_reference(const Scene& scene,
                                                  const SimulationOptions& options = {});

}  // namespace hapticwall
