// hapticwall run SCENE: one session without a window.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/headless.h"
#include "app/command/realtime_run.h"
#include "app/command/run_outputs.h"
#include "app/command/signals.h"
#include "app/command/summary_fields.h"
#include "app/command/summary_table.h"
#include "app/command/terminal.h"
#include "app/file/text.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

struct RunOptions {
  SceneOptions scene;
  OutputOptions output;
  bool realtime = false;
  bool arm = false;
};

// What was run, however it was run.
struct RunOutcome {
  Summary summary;
  bool stopped_early = false;
  std::string realtime_status;
};

Failure check_arming(const RunOptions& options, const DeviceChoice& device) {
  if (!options.arm || device.hardware) return {};
  return Error{ErrorKind::kUsage,
               "--arm: the simulator needs no arming; it is for --device ie2000"};
}

Failure check_spin(const RunOptions& options, bool in_real_time) {
  const Result<double> spin_s = spin_seconds(options.scene.spin_us);
  if (!spin_s) return spin_s.error();
  if (*spin_s == 0.0 || in_real_time) return {};
  return Error{ErrorKind::kUsage, "--spin: it is for --realtime and for a device"};
}

Failure check_realtime(const SceneOptions& options, const file::LoadedScene& loaded) {
  if (loaded.changes.empty() && loaded.first_recorded_tick == 0) return {};
  return Error{ErrorKind::kUsage,
               fmt::format("{}: a part of a session, or one in which parameters changed; only a "
                           "run without --realtime repeats it, tick by tick",
                           file::shown(options.scene))};
}

std::function<void(const Sample&, const Sample&)> sample_sink(RunOutputs& outputs) {
  if (!outputs.wants_samples()) return {};
  return [&outputs](const Sample& x, const Sample& y) { outputs.take(x, y); };
}

Result<RunOutcome> run_in_real_time(const RunOptions& options, const DeviceChoice& device,
                                    const Scene& scene, RunOutputs& outputs) {
  const Result<RealtimeOutcome> result =
      run_realtime({.scene = scene,
                    .csv = options.output.csv,
                    .on_sample = sample_sink(outputs),
                    .hardware = device.hardware,
                    .arm = options.arm,
                    .allow_no_realtime = options.scene.allow_no_realtime,
                    .spin_s = options.scene.spin_us / kMicrosecondsPerSecond,
                    .show_progress = !options.output.quiet});
  if (!result) return result.error();
  return RunOutcome{result->summary, result->stopped_early, result->status};
}

Result<RunOutcome> run_headless(const RunOptions& options, const file::LoadedScene& loaded,
                                RunOutputs& outputs) {
  const SimulationResult result =
      simulate_timed({.scene = loaded.scene,
                      .changes = loaded.changes,
                      .on_sample = sample_sink(outputs),
                      .should_stop = [&] { return outputs.failure().has_value(); },
                      .progress_label = loaded.scene.name,
                      .show_progress = !options.output.quiet});
  const std::uint64_t ticks =
      result.stopped_early ? result.summary.ticks : loaded.scene.tick_count();
  if (Failure failed = outputs.finish_recording(loaded, ticks)) return *failed;
  return RunOutcome{result.summary, result.stopped_early, ""};
}

int tell_stopped(const RunOutcome& outcome, const Scene& scene, const std::string& csv) {
  tell(fmt::format("ended early by {} after {} of {} ticks{}", signal_name(stop_signal()),
                   outcome.summary.ticks, scene.tick_count(),
                   csv.empty() ? "" : "; " + file::shown(csv) + " holds what was run"));
  return signal_exit_status(stop_signal());
}

Failure print_summary(const OutputOptions& options, const Scene& scene, const RunOutcome& outcome) {
  if (options.json == kStandardOutput) return write_output(summary_json(outcome.summary));
  if (options.quiet) return {};
  const Summary& summary = outcome.summary;
  const bool hand_moves = hand_moves_in_tail(scene, summary, summary.duration_s);
  return write_output(summary_lines(summary, {outcome.realtime_status, hand_moves}));
}

int run(const RunOptions& options) {
  const Result<std::vector<Expectation>> expectations =
      parse_expectations(options.output.expectations);
  if (!expectations) return report(expectations.error());
  if (const Failure failed = check_outputs(options.output, {options.scene.scene}))
    return report(*failed);
  const Result<DeviceChoice> device = parse_device_choice(options.scene.device);
  if (!device) return report(device.error());
  if (const Failure failed = check_arming(options, *device)) return report(*failed);
  const bool in_real_time = options.realtime || device->hardware.has_value();
  if (const Failure failed = check_spin(options, in_real_time)) return report(*failed);
  const Result<file::LoadedScene> loaded =
      device->hardware ? load(options.scene) : load_headless(options.scene);
  if (!loaded) return report(loaded.error());
  if (in_real_time) {
    if (const Failure failed = check_realtime(options.scene, *loaded)) return report(*failed);
  }
  Result<RunOutputs> outputs = RunOutputs::open(options.output, *loaded, in_real_time);
  if (!outputs) return report(outputs.error());
  if (!loaded->not_repeatable_because.empty() && !options.output.quiet && !device->hardware) {
    tell(fmt::format("note: this will differ from the recorded session: {}",
                     file::shown(loaded->not_repeatable_because)));
  }

  catch_stop_signals();
  const Result<RunOutcome> outcome =
      in_real_time ? run_in_real_time(options, *device, loaded->scene, *outputs)
                   : run_headless(options, *loaded, *outputs);
  if (!outcome) return report(outcome.error());
  if (outcome->stopped_early) return tell_stopped(*outcome, loaded->scene, options.output.csv);
  if (const Failure failed = outputs->finish(loaded->scene, outcome->summary)) {
    return report(*failed);
  }
  if (const Failure failed = print_summary(options.output, loaded->scene, *outcome)) {
    return report(*failed);
  }
  return judge(*expectations, {&outcome->summary, 1});
}

}  // namespace

Command add_run(CLI::App& program) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* app = program.add_subcommand("run", "Run a scene without a window and print a summary");
  add_headless_options(*app, options->scene);
  add_algorithm_option(*app, options->scene);
  add_scene_options(*app, options->scene);
  add_device_options(*app, options->scene);
  app->add_flag("--realtime", options->realtime,
                "In real time, through the loop that the window uses; always so on a device");
  app->add_flag("--arm", options->arm,
                "Let a device push, as soon as its handle is seen outside the wall; without it the "
                "force stays off");
  app->add_option("--csv", options->output.csv,
                  "Record every tick; the sidecar FILE.toml repeats the run")
      ->type_name("FILE");
  app->add_option("--plot", options->output.plot, "Draw the figure of the run; needs no display")
      ->type_name("FILE.png");
  add_output_options(*app, options->output);
  return {app, [options] { return run(*options); }};
}

}  // namespace hapticwall::command
