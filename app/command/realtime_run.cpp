#include "app/command/realtime_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

#include "app/command/progress.h"
#include "app/command/signals.h"
#include "app/runtime/session.h"
#include "core/metrics.h"

namespace hapticwall::command {
namespace {

constexpr std::chrono::milliseconds kPollInterval{5};
constexpr std::size_t kSamplesPerPoll = 4096;
constexpr double kMicrosecondsPerSecond = 1e6;

std::string status_text(const runtime::Session& session, const runtime::TimingStatistics& timing) {
  return fmt::format("{}; {} ticks missed, woken at most {:.0f} us late",
                     session.realtime_status().text, timing.missed_ticks,
                     timing.maximum_wake_latency_s * kMicrosecondsPerSecond);
}

// Takes what the loop has produced; returns how many samples that was.
std::uint64_t take_samples(runtime::Session& session, Metrics& metrics, const RealtimeRun& run) {
  static thread_local std::array<Sample, kSamplesPerPoll> buffer;
  const std::size_t count = session.take_samples(buffer);
  for (std::size_t i = 0; i < count; ++i) {
    metrics.add(buffer.at(i));
    if (run.on_sample) run.on_sample(buffer.at(i));
  }
  return count;
}

}  // namespace

Result<RealtimeOutcome> run_realtime(const RealtimeRun& run) {
  const std::uint64_t ticks = run.scene.tick_count();
  if (ticks > UINT32_MAX) {
    return Error{ErrorKind::kUsage, fmt::format("--realtime runs at most {} ticks", UINT32_MAX)};
  }
  runtime::SessionOptions options;
  options.start_paused = true;  // the recording begins with tick 0
  Result<std::unique_ptr<runtime::Session>> started = runtime::Session::start(run.scene, options);
  if (!started) return started.error();
  runtime::Session& session = **started;
  if (!run.csv.empty()) {
    if (Failure failed = session.start_recording(run.csv)) return *failed;
  }

  Metrics metrics(run.scene, ticks, true);
  Progress progress(run.scene.name, run.show_progress);
  session.step(static_cast<std::uint32_t>(ticks));
  std::uint64_t done = 0;
  while (done < ticks && stop_signal() == 0) {
    done += take_samples(session, metrics, run);
    if (session.dropped_plot_samples() > 0) {
      return Error{ErrorKind::kDevice, "samples were lost: this machine is too slow for the rate"};
    }
    if (session.snapshot().ended_by_fault) {
      return Error{ErrorKind::kDevice, fmt::format("the loop gave up after {} ticks", done)};
    }
    progress.show(static_cast<double>(done) / static_cast<double>(ticks));
    if (done < ticks) std::this_thread::sleep_for(kPollInterval);
  }
  if (Failure failed = session.stop_recording()) return *failed;
  return RealtimeOutcome{metrics.finish(), status_text(session, session.snapshot().timing),
                         done < ticks};
}

}  // namespace hapticwall::command
