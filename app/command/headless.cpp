#include "app/command/headless.h"

#include <chrono>

#include "app/command/progress.h"
#include "app/command/signals.h"

namespace hapticwall::command {
namespace {

// About as many ticks lie between two questions of simulate() whether to stop; only the bar uses
// it.
constexpr double kTicksPerQuestion = 1024.0;
constexpr double kNanosecondsPerSecond = 1e9;

}  // namespace

SimulationResult simulate_timed(const HeadlessRun& run) {
  Progress progress(run.progress_label, run.show_progress);
  const auto ticks = static_cast<double>(run.scene.tick_count());
  double asked = 0.0;
  SimulationOptions options;
  options.on_sample = run.on_sample;
  options.changes = run.changes;
  options.should_stop = [&] {
    progress.show(kTicksPerQuestion * asked++ / ticks);
    return stop_signal() != 0 || (run.should_stop && run.should_stop());
  };
  const auto start = std::chrono::steady_clock::now();
  SimulationResult result = simulate(run.scene, options);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  Summary& summary = result.summary;
  if (summary.ticks > 0 && elapsed.count() > 0.0) {
    summary.ns_per_tick =
        elapsed.count() * kNanosecondsPerSecond / static_cast<double>(summary.ticks);
    summary.simulated_seconds_per_second = summary.duration_s / elapsed.count();
  }
  return result;
}

}  // namespace hapticwall::command
