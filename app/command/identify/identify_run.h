// The session of `hapticwall identify`: an experiment in the real-time loop, and its record.
#pragma once

#include <memory>

#include "app/command/run/realtime_run.h"
#include "app/runtime/session/identify_experiment.h"

namespace hapticwall::command {

struct IdentifyRun {
  const Scene& scene;                        // one axis without hand and walls
  runtime::IdentifyExperiment& experiment;   // its rate, limit and encoder are those of the scene
  std::unique_ptr<device::Device> device{};  // as in RealtimeRun
  bool allow_no_realtime = false;
  bool allow_slow_device = false;
  bool show_progress = false;
};

struct IdentifyOutcome {
  std::uint64_t missed_ticks = 0;
  bool stopped_early = false;
};

// Arms the device, waits for its whole force and runs the experiment. A device that is lost or
// disarmed, and an experiment that stopped by itself, are an error (ErrorKind::kDevice). The force
// is zero when this returns. A simulator takes no time.
[[nodiscard]] Result<IdentifyOutcome> run_experiment(IdentifyRun run);

}  // namespace hapticwall::command
