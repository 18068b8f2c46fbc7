// A session in real time without a window.
#pragma once

#include <functional>
#include <string>

#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::command {

struct RealtimeRun {
  const Scene& scene;
  std::string csv;                               // empty: no recording
  std::function<void(const Sample&)> on_sample;  // may be empty
  bool show_progress = false;
};

struct RealtimeOutcome {
  Summary summary;
  std::string status;  // of the real-time loop, in words
  bool stopped_early = false;
};

// Runs exactly scene.tick_count() ticks (fewer after a stop signal) and finishes the recording.
[[nodiscard]] Result<RealtimeOutcome> run_realtime(const RealtimeRun& run);

}  // namespace hapticwall::command
