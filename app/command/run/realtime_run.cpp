#include "app/command/run/realtime_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "app/command/device_choice.h"
#include "app/command/report/axes_metrics.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/text/text.h"
#include "app/runtime/session/live_session.h"
#include "core/sample.h"
#include "core/simulation/simulate.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

constexpr std::chrono::milliseconds kPollInterval{5};
constexpr std::size_t kTicksPerPoll = 4096;

// Age of positions and missing reports of a real device.
std::string link_text(const runtime::LiveSession& session, const device::LinkStats& link) {
  return fmt::format("; {}: {} states, {} missing, {} void, at most {:.0f} us old, delay {:.0f} us",
                     session.device_info().name, link.states, link.missing_states,
                     link.void_reports, link.maximum_age_s * kMicrosecondsPerSecond,
                     link.delay_s * kMicrosecondsPerSecond);
}

std::string status_text(const runtime::LiveSession& session, const runtime::Snapshot& snapshot) {
  const runtime::TimingStatistics& timing = snapshot.timing;
  std::string text = fmt::format("{}; {} ticks missed, woken at most {:.0f} us late",
                                 session.realtime_status().text, timing.missed_ticks,
                                 timing.maximum_wake_latency_s * kMicrosecondsPerSecond);
  if (!session.device_info().is_simulated) text += link_text(session, snapshot.link);
  return text;
}

// Takes what the loop has produced.
class TickTaker {
 public:
  TickTaker(const Scene& scene, bool has_truth)
      : metrics_(scene, scene.tick_count(), has_truth), ticks_(kTicksPerPoll) {}

  // Returns the number of ticks.
  std::uint64_t take(runtime::LiveSession& session, const RealtimeRun& run) {
    const std::size_t count = session.take_ticks(ticks_);
    for (const Tick& tick : std::span(ticks_).first(count)) {
      metrics_.add(tick);
      if (run.on_tick) run.on_tick(tick);
    }
    return count;
  }
  [[nodiscard]] RunSummary summary() const { return metrics_.finish(); }

 private:
  AxesMetrics metrics_;
  std::vector<Tick> ticks_;
};

Result<std::unique_ptr<runtime::LiveSession>> start_session(const RealtimeRun& run) {
  runtime::SessionOptions options;
  options.start_paused = true;  // the recording begins with tick 0
  options.allow_no_realtime = run.allow_no_realtime;
  options.spin_s = run.spin_s;
  if (!run.hardware) return runtime::LiveSession::start(run.scene, options);
  return runtime::LiveSession::start_on(make_device(*run.hardware, run.scene), run.scene, options);
}

// Trouble that ends a run early.
Failure trouble_in(const runtime::LiveSession& session, const runtime::Snapshot& snapshot,
                   const RealtimeRun& run) {
  const auto failed = [](std::string text) { return device_error(std::move(text)); };
  if (snapshot.ended_by_fault) {
    return failed(
        fmt::format("the loop ended by a fault after {} ticks", snapshot.newest.x().tick));
  }
  const Sample& newest = snapshot.newest.x();
  if (session.device_info().is_simulated && (newest.flags & kFlagDeviceFault) != 0) {
    return usage_error(fmt::format("a tick before {:.3f} s is {}", newest.time_s, kTooMuchWork));
  }
  if (session.dropped_plot_samples() > 0) {
    return failed(
        "samples were lost: this machine is too slow for the rate; choose a lower "
        "sampling.rate_hz");
  }
  const runtime::ArmingStatus& arming = snapshot.arming;
  const std::string& name = session.device_info().name;
  if (snapshot.link.trouble != device::Trouble::kNone) {
    const std::string details = session.device_trouble();
    return failed(
        fmt::format("{}: {}; the force is off since {:.3f} s", name,
                    details.empty() ? device::trouble_text(snapshot.link.trouble) : details,
                    snapshot.newest.x().time_s));
  }
  // The pause after the last tick is no trouble.
  if (run.arm && arming.asked > 0 && arming.state == runtime::ArmingState::kOff &&
      arming.note != runtime::ArmingNote::kPaused) {
    return failed(fmt::format("{}: the force is off since {:.3f} s: {}", name,
                              snapshot.newest.x().time_s, runtime::arming_note_text(arming.note)));
  }
  return {};
}

// Drops the remaining steps, so that summary and recording end with the same tick.
void leave_out_the_rest(runtime::LiveSession& session) {
  session.pause(false);
  session.pause(true);
}

// Reports a failing recording at once; the run continues and fails at its end.
class RecordingWatch {
 public:
  void look(const runtime::LiveSession& session) {
    if (told_) return;
    const runtime::RecordingStatus status = session.recording_status();
    std::string trouble;
    if (status.state == runtime::RecordingState::kFailed) {
      trouble = status.error;
    } else if (status.dropped_rows > 0) {
      trouble = file::shown(status.path) + ": rows are missing: the disk is too slow";
    }
    if (trouble.empty()) return;
    tell(trouble + "; the run continues");
    told_ = true;
  }

 private:
  bool told_ = false;
};

}  // namespace

Result<RealtimeOutcome> run_realtime(const RealtimeRun& run) {
  const std::uint64_t ticks = run.scene.tick_count();
  if (ticks > UINT32_MAX) {
    return usage_error(fmt::format("--realtime runs at most {} ticks", UINT32_MAX));
  }
  Result<std::unique_ptr<runtime::LiveSession>> started = start_session(run);
  if (!started) return started.error();
  runtime::LiveSession& session = **started;
  if (!run.csv.empty()) {
    if (Failure failed = session.start_recording(run.csv)) return *failed;
  }

  TickTaker taker(session.scene(), session.device_info().is_simulated);
  Progress progress(run.scene.name, run.show_progress);
  session.step(static_cast<std::uint32_t>(ticks));
  if (run.arm) session.arm(true);
  Failure trouble;
  RecordingWatch recording;
  std::uint64_t done = 0;
  while (done < ticks && stop_signal() == 0 && !trouble) {
    done += taker.take(session, run);
    trouble = trouble_in(session, session.snapshot(), run);
    recording.look(session);
    progress.show(static_cast<double>(done) / static_cast<double>(ticks));
    if (done < ticks && !trouble) std::this_thread::sleep_for(kPollInterval);
  }
  session.arm(false);
  leave_out_the_rest(session);
  Failure recording_failure = session.stop_recording();
  while (const std::uint64_t taken = taker.take(session, run)) done += taken;
  if (trouble) return *trouble;
  return RealtimeOutcome{taker.summary(), status_text(session, session.snapshot()), done < ticks,
                         std::move(recording_failure)};
}

}  // namespace hapticwall::command
