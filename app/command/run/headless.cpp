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

SimulationResult simulate_one(const HeadlessRun& run, const std::function<bool()>& should_stop) {
  SimulationOptions options;
  if (run.on_sample) {
    options.on_sample = [&](const Sample& sample) { run.on_sample(sample, Sample{}); };
  }
  options.changes = run.changes;
  options.should_stop = should_stop;
  return simulate(run.scene, options);
}

SimulationResult simulate_both(const HeadlessRun& run, const std::function<bool()>& should_stop) {
  AxesResult axes = simulate_axes(
      run.scene, {.on_samples = run.on_sample, .should_stop = should_stop, .changes = run.changes});
  axes.x.summary.y.push_back(axes.y.summary);
  return axes.x;
}

}  // namespace

SimulationResult simulate_timed(const HeadlessRun& run) {
  Progress progress(run.progress_label, run.show_progress);
  const auto ticks = static_cast<double>(run.scene.tick_count());
  double asked = 0.0;
  const auto should_stop = [&] {
    progress.show(kTicksPerQuestion * asked++ / ticks);
    return stop_signal() != 0 || (run.should_stop && run.should_stop());
  };
  const auto start = std::chrono::steady_clock::now();
  SimulationResult result =
      run.scene.y ? simulate_both(run, should_stop) : simulate_one(run, should_stop);
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
