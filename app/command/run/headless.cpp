#include "app/command/run/headless.h"

#include <chrono>

#include "app/command/report/progress.h"
#include "app/command/signals.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

// Approximate number of ticks between two calls of should_stop(); serves the progress bar.
constexpr double kTicksPerQuestion = 1024.0;

}  // namespace

HeadlessResult simulate_timed(const HeadlessRun& run) {
  Progress progress(run.progress_label, run.show_progress);
  const auto ticks = static_cast<double>(run.scene.tick_count());
  double asked = 0.0;
  const auto should_stop = [&] {
    progress.show(kTicksPerQuestion * asked++ / ticks);
    return stop_signal() != 0 || (run.should_stop && run.should_stop());
  };
  const auto start = std::chrono::steady_clock::now();
  const AxesResult axes = simulate_axes(run.scene, {.on_tick = run.on_tick,
                                                    .should_stop = should_stop,
                                                    .changes = run.changes,
                                                    .signals = run.signals});
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  HeadlessResult result{{}, axes.stopped_early};
  for (const SimulationResult& axis : axes.axes) result.summary.push_back(axis.summary);
  Summary& summary = result.summary.front();
  if (summary.ticks > 0 && elapsed.count() > 0.0) {
    summary.ns_per_tick =
        elapsed.count() * kNanosecondsPerSecond / static_cast<double>(summary.ticks);
    summary.simulated_seconds_per_second = summary.duration_s / elapsed.count();
  }
  return result;
}

}  // namespace hapticwall::command
