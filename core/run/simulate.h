// A whole scene on the built-in simulator, as fast as possible: no clock, no thread, no file.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

// Thrown by simulate() and by batches: a tick of the scene is too much work for the exact
// integrator. The message names the tick and the way out.
struct SimulationRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};
inline constexpr std::string_view kTooMuchWork =
    "too much work for the exact integrator: use a heavier hand, a softer grip or another "
    "simulator.integrator";

struct SimulationOptions {
  // Called with the sample of every tick, in order; empty: samples are not assembled.
  std::function<void(const Sample&)> on_sample;
  // Called about every thousand ticks, and sooner if they take long; true ends the run early.
  std::function<bool()> should_stop;
  // Sorted by tick.
  std::span<const ScheduledChange> changes;
  bool signals = false;  // true: the samples have the algorithm's signals
};

struct SimulationResult {
  Summary summary;
  // `should_stop` returned true: the summary is of the ticks so far.
  bool stopped_early = false;
  Sample final_state;  // at t = ticks * T: true state and energies, no force
};

// Precondition of a headless run: throws std::invalid_argument for a hand that follows the mouse.
void refuse_pointer(const Scene& scene);

// Runs a validated scene. Precondition: that of refuse_pointer(). Deterministic: same scene, same
// bits. Realtime-safe: no (allocates at set-up, never in the loop).
[[nodiscard]] SimulationResult simulate(const Scene& scene, const SimulationOptions& options = {});

struct AxesOptions {
  // Called with every tick, in order; empty: ticks are not assembled.
  std::function<void(const Tick&)> on_tick;
  std::function<bool()> should_stop;         // see SimulationOptions
  std::span<const ScheduledChange> changes;  // of scenes with as many axes, sorted by tick
  bool signals = false;                      // see SimulationOptions
};

struct AxesResult {
  std::vector<SimulationResult> axes;
  bool stopped_early = false;
};

// All axes of a scene, each as simulate() would run it alone: they share only the clock. If one
// diverges all end, at most kAxesApartTicks later. Axes that need each other (couples_axes()) tick
// together, which takes longer. Preconditions: those of simulate().
// Realtime-safe: no.
[[nodiscard]] AxesResult simulate_axes(const Scene& scene, const AxesOptions& options = {});
inline constexpr std::uint64_t kAxesApartTicks = 1024;

// The reference for measuring integrators: the same closed loop with the exact integrator, whatever
// the scene's, and the plant in extended precision (long double, 64 bits of mantissa). The
// controller computes in double. Samples and summary are rounded to double. Several times slower.
// Realtime-safe: no.
[[nodiscard]] SimulationResult simulate_reference(const Scene& scene,
                                                  const SimulationOptions& options = {});

}  // namespace hapticwall
