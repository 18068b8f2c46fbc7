// A session in real time without a window, on the simulator or on a device.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"
#include "device/hid/impulse_engine.h"

namespace hapticwall::command {

struct RealtimeRun {
  const Scene& scene;
  std::string csv;                                       // empty: no recording
  std::function<void(const Tick&)> on_tick;              // as in HeadlessRun
  std::optional<device::ImpulseEngineOptions> hardware;  // nullopt: the simulator
  bool arm = false;                                      // arms the device at the first tick
  bool allow_no_realtime = false;
  double spin_s = 0.0;  // as in SessionOptions
  bool show_progress = false;
};

struct RealtimeOutcome {
  RunSummary summary;
  std::string status;  // of the real-time loop, in words
  bool stopped_early = false;
  Failure recording_failure;
};

// Runs exactly scene.tick_count() ticks, fewer after a stop signal, and finishes the recording. A
// device that is lost or cannot be armed ends the run with ErrorKind::kDevice, with zero force and
// a finished recording. A recording that fails does not end it.
[[nodiscard]] Result<RealtimeOutcome> run_realtime(const RealtimeRun& run);

}  // namespace hapticwall::command
