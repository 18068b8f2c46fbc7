// Runs a scene on the simulator, and measures the time.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "core/run/simulate.h"

namespace hapticwall::command {

struct HeadlessRun {
  const Scene& scene;
  std::span<const ScheduledChange> changes;
  std::function<void(const Tick&)> on_tick;  // empty: ticks are not assembled
  bool signals = false;                      // see SimulationOptions::signals
  std::function<bool()> should_stop;         // in addition to stop signals; may be empty
  std::string progress_label;
  bool show_progress = false;
};

struct HeadlessResult {
  RunSummary summary;
  bool stopped_early = false;
};

// Simulates all axes with clock metrics; a stop signal ends it early.
[[nodiscard]] HeadlessResult simulate_timed(const HeadlessRun& run);

}  // namespace hapticwall::command
