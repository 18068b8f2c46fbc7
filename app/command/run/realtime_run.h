// A session in real time without a window, on the simulator or on a device.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"
#include "device/impulse_engine.h"

namespace hapticwall::command {

struct RealtimeRun {
  const Scene& scene;
  std::string csv;                                                  // empty: no recording
  std::function<void(const Sample& x, const Sample& y)> on_sample;  // as in HeadlessRun
  std::optional<device::ImpulseEngineOptions> hardware;             // nothing: the simulator
  bool arm = false;  // the device's force, at the first tick; else it stays off
  bool allow_no_realtime = false;
  double spin_s = 0.0;  // as runtime::SessionOptions
  bool show_progress = false;
};

struct RealtimeOutcome {
  Summary summary;
  std::string status;  // of the real-time loop, in words
  bool stopped_early = false;
};

// Runs exactly scene.tick_count() ticks (fewer after a stop signal) and finishes the recording. A
// device that cannot be armed, or is lost on the way, ends the run with ErrorKind::kDevice; its
// force is zero then, and the recording is whole for what was run.
[[nodiscard]] Result<RealtimeOutcome> run_realtime(const RealtimeRun& run);

}  // namespace hapticwall::command
