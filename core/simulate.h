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

// The same closed loop with the exact integrator, whatever the scene names, and the plant in
// extended precision (long double, 64 bits of mantissa); the controller is a digital computer and
// computes in double as ever. Samples and summary are rounded to double. The reference against
// which integrators are measured; several times slower.
[[nodiscard]] SimulationResult simulate_reference(const Scene& scene,
                                                  const SimulationOptions& options = {});

}  // namespace hapticwall
