#include "app/command/run/realtime_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "app/command/report/axes_metrics.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/text/text.h"
#include "app/session/loop_session.h"
#include "core/run/simulate.h"
#include "core/sample.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

constexpr std::chrono::milliseconds kPollInterval{5};
constexpr std::size_t kTicksPerPoll = 4096;

// Age of positions and missing reports of a real device.
std::string link_text(const session::LiveSession& session, const device::LinkStats& link) {
  const std::string delay = link.delay_s > 0.0
                                ? fmt::format("{:.0f} us", link.delay_s * kMicrosecondsPerSecond)
                                : "unknown";
  if (!link.acknowledges) {
    return fmt::format("; {}: {} changes of position, at most {:.0f} us old, delay {}",
                       session.device_info().name, link.states,
                       link.maximum_age_s * kMicrosecondsPerSecond, delay);
  }
  return fmt::format("; {}: {} states, {} missing, {} void, at most {:.0f} us old, delay {}",
                     session.device_info().name, link.states, link.missing_states,
                     link.void_reports, link.maximum_age_s * kMicrosecondsPerSecond, delay);
}

std::string status_text(const session::LiveSession& session, const session::Snapshot& snapshot) {
  const session::TimingStatistics& timing = snapshot.timing;
  std::string text = fmt::format("{}; {} ticks missed, woken at most {:.0f} us late",
                                 session.realtime_status().text, timing.missed_ticks,
                                 timing.maximum_wake_latency_s * kMicrosecondsPerSecond);
  if (!session.device_info().is_simulated) text += link_text(session, snapshot.link);
  return text;
}

// Forwards the ticks that the loop has produced.
class TickTaker {
 public:
  TickTaker(const Scene& scene, bool is_simulated)
      : metrics_(scene, scene.tick_count(),
                 is_simulated ? SampleOrigin::kSimulator : SampleOrigin::kDeviceWithForce),
        ticks_(kTicksPerPoll) {}

  // Returns the number of ticks.
  std::uint64_t take(session::LiveSession& session, const RealtimeRun& run) {
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

Result<std::unique_ptr<session::LiveSession>> start_session(RealtimeRun& run) {
  session::SessionOptions options;
  options.start_paused = true;  // the recording begins with tick 0
  options.allow_no_realtime = run.allow_no_realtime;
  options.allow_slow_device = run.allow_slow_device;
  options.spin_s = run.spin_s;
  options.stream = run.stream;
  options.signals = run.signals;
  options.clock = run.clock;
  return session::start_under(run.borrowed, std::move(run.device), run.scene, options);
}

Failure device_trouble(const session::LiveSession& session, double since_s, std::string_view why) {
  return device_error(fmt::format("{}: {}; the force is off since {:.3f} s",
                                  session.device_info().name, why, since_s));
}

// The pause after the last tick is no fault, and a handle inside the wall may come out.
bool was_disarmed(const session::ArmingStatus& arming) {
  return (arming.asked > 0 || arming.note == session::ArmingNote::kUnaskedForce) &&
         arming.state == session::ArmingState::kOff &&
         arming.note != session::ArmingNote::kPaused &&
         arming.note != session::ArmingNote::kInsideWall;
}

bool tells_unasked_force(const session::Snapshot& snapshot) {
  return snapshot.arming.note == session::ArmingNote::kUnaskedForce;
}

// Trouble that ends a run early.
Failure trouble_in(const session::LiveSession& session, const session::Snapshot& snapshot,
                   const RealtimeRun& run) {
  const auto failed = [](std::string text) { return device_error(std::move(text)); };
  const Sample& newest = snapshot.newest.x();
  if (snapshot.ended_by_fault) {
    return failed(fmt::format("the loop ended by a fault after {} ticks", newest.tick));
  }
  if (session.device_info().is_simulated && (newest.flags & kFlagDeviceFault) != 0) {
    return usage_error(fmt::format("a tick before {:.3f} s is {}", newest.time_s, kTooMuchWork));
  }
  if (session.dropped_plot_samples() > 0) {
    return failed(
        "samples were lost: this machine is too slow for the rate; choose a lower "
        "sampling.rate_hz");
  }
  if (snapshot.link.trouble != device::Trouble::kNone) {
    const std::string details = session.device_trouble();
    return device_trouble(session, newest.time_s,
                          details.empty() ? device::trouble_text(snapshot.link.trouble) : details);
  }
  if (!(run.arm || tells_unasked_force(snapshot)) || !was_disarmed(snapshot.arming)) return {};
  return device_trouble(session, snapshot.arming.since_s,
                        session::arming_note_text(snapshot.arming.note));
}

// Asks for the force until the handle is outside the wall.
class ArmingRequest {
 public:
  void ask(session::LiveSession& session) {
    session.arm(true);
    ++asked_;
  }
  void look(session::LiveSession& session, const session::ArmingStatus& arming) {
    const bool refused =
        asked_ > 0 && arming.asked == asked_ && arming.note == session::ArmingNote::kInsideWall;
    if (arming.state != session::ArmingState::kOff) waits_ = false;
    if (!refused) return;
    if (!waits_) {
      tell(fmt::format("{}; the force stays off until then",
                       session::arming_note_text(arming.note)));
    }
    waits_ = true;
    ask(session);
  }
  // Why the force was off to the end.
  [[nodiscard]] Failure trouble() const {
    if (!waits_) return {};
    return device_error("the force stayed off: the handle was inside the wall to the end");
  }

 private:
  std::uint32_t asked_ = 0;
  bool waits_ = false;
};

// Adds the session's values to the summary of its ticks.
void add_session(const session::LiveSession& session, const session::Snapshot& snapshot, bool armed,
                 Summary& summary) {
  summary.missed_ticks = snapshot.timing.missed_ticks;
  if (session.device_info().is_simulated) return;
  const device::LinkStats& link = snapshot.link;
  if (link.acknowledges) {
    summary.missing_states = link.missing_states;
    summary.void_reports = link.void_reports;
    summary.applied_commands = link.applied_commands;
    summary.lost_commands = link.lost_commands;
    summary.rejected_commands = link.rejected_commands;
  }
  if (link.delay_s > 0.0) summary.delay_s = link.delay_s;
  if (snapshot.arming.mostly_at_limit(session.scene().sampling.rate_hz))
    summary.verdict_note = session::kAtLimitText;
  if (!(armed || tells_unasked_force(snapshot)) || !was_disarmed(snapshot.arming)) return;
  summary.disarmed_at_s = snapshot.arming.since_s;
  summary.disarm_reason = link.trouble != device::Trouble::kNone
                              ? device::trouble_text(link.trouble)
                              : session::arming_note_text(snapshot.arming.note);
}

// Drops the remaining steps, so that summary and recording end with the same tick.
void leave_out_the_rest(session::LiveSession& session) {
  session.pause(false);
  session.pause(true);
}

// Reports a failing recording at once; the run continues and fails at its end.
class RecordingWatch {
 public:
  void look(const session::LiveSession& session) {
    if (told_) return;
    const session::RecordingStatus status = session.recording_status();
    std::string trouble;
    if (status.state == session::RecordingState::kFailed) {
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

Result<RealtimeOutcome> run_realtime(RealtimeRun run) {
  const std::uint64_t ticks = run.scene.tick_count();
  if (ticks > UINT32_MAX) {
    return usage_error(fmt::format("--realtime runs at most {} ticks", UINT32_MAX));
  }
  Result<std::unique_ptr<session::LiveSession>> started = start_session(run);
  if (!started) return started.error();
  session::LiveSession& session = **started;
  if (!run.csv.empty()) {
    if (Failure failed = session.start_recording(run.csv)) return *failed;
  }

  TickTaker taker(session.scene(), session.device_info().is_simulated);
  Progress progress(run.scene.name, run.show_progress);
  session.step(static_cast<std::uint32_t>(ticks));
  ArmingRequest request;
  if (run.arm) request.ask(session);
  RealtimeOutcome outcome;
  RecordingWatch recording;
  session::Snapshot snapshot;
  std::uint64_t done = 0;
  bool ends = false;
  while (done < ticks && stop_signal() == 0 && !outcome.trouble && !ends) {
    done += taker.take(session, run);
    snapshot = session.snapshot();
    request.look(session, snapshot.arming);
    ends = run.ends && run.ends(snapshot);
    outcome.trouble = trouble_in(session, snapshot, run);
    recording.look(session);
    progress.show(static_cast<double>(done) / static_cast<double>(ticks));
    if (done < ticks && !outcome.trouble && !ends) std::this_thread::sleep_for(kPollInterval);
  }
  if (outcome.trouble && outcome.trouble->kind == ErrorKind::kUsage) return *outcome.trouble;
  session.arm(false);
  leave_out_the_rest(session);
  outcome.recording_failure = session.stop_recording();
  while (const std::uint64_t taken = taker.take(session, run)) done += taken;
  if (!outcome.trouble && done == ticks) outcome.trouble = request.trouble();
  outcome.summary = taker.summary();
  outcome.status = status_text(session, snapshot);
  outcome.stopped_early = done < ticks;
  add_session(session, snapshot, run.arm, outcome.summary.front());
  return outcome;
}

}  // namespace hapticwall::command
