// A scene through the simulator with a clock beside it.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "core/simulate.h"

namespace hapticwall::command {

struct HeadlessRun {
  const Scene& scene;
  std::span<const ScheduledChange> changes;
  // `y`: of a scene's second axis. Empty: samples are not assembled.
  std::function<void(const Sample& x, const Sample& y)> on_sample;
  std::function<bool()> should_stop;  // beside signals; may be empty
  std::string progress_label;
  bool show_progress = false;
};

// simulate(), ended early by a stop signal, with the figures that only a clock gives.
[[nodiscard]] SimulationResult simulate_timed(const HeadlessRun& run);

}  // namespace hapticwall::command
