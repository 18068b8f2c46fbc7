// A session in real time without a window, on the simulator or on a device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/file/recording/sample_stream.h"
#include "app/session/loop/snapshot.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"
#include "device/device.h"

namespace hapticwall {
struct BorrowedAlgorithm;
}
namespace hapticwall::session {
class Clock;
}

namespace hapticwall::command {

struct RealtimeRun {
  const Scene& scene;
  std::string csv{};                           // empty: no recording
  std::function<void(const Tick&)> on_tick{};  // see HeadlessRun::on_tick
  std::unique_ptr<device::Device> device{};    // not open yet; nullptr: the simulator
  bool arm = false;                            // arms the device as soon as it can
  bool allow_no_realtime = false;
  bool allow_slow_device = false;
  double spin_s = 0.0;  // see SessionOptions
  bool show_progress = false;
  std::shared_ptr<file::SampleStream> stream{};  // gets every tick; null: none
  std::vector<file::SignalColumn> signals{};     // see SessionOptions
  BorrowedAlgorithm* borrowed = nullptr;         // as in session::start_under()
  session::Clock* clock = nullptr;               // see SessionOptions
  // Looks at the newest state every few milliseconds; true ends the run.
  std::function<bool(const session::Snapshot&)> ends{};
};

struct RealtimeOutcome {
  RunSummary summary;
  std::string status;  // status of the real-time loop, in words
  bool stopped_early = false;
  Failure trouble;  // the failure that ended the run early
  Failure recording_failure;
};

// Runs exactly scene.tick_count() ticks, fewer after a stop signal, and finishes the recording. To
// arm waits while the handle is inside the wall. A device that is lost or disarmed ends the run
// with zero force: the outcome then has the ticks so far, and the trouble (ErrorKind::kDevice). A
// recording that fails does not end it.
[[nodiscard]] Result<RealtimeOutcome> run_realtime(RealtimeRun run);

}  // namespace hapticwall::command
