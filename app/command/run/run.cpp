// hapticwall run SCENE: one session without a window.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/report/expectation.h"
#include "app/command/report/summary_table.h"
#include "app/command/report/terminal.h"
#include "app/command/run/film_options.h"
#include "app/command/run/film_output.h"
#include "app/command/run/headless.h"
#include "app/command/run/realtime_run.h"
#include "app/command/run/run_outputs.h"
#include "app/command/signals.h"
#include "app/file/disk/sha256.h"
#include "app/file/text/text.h"
#include "core/result.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

struct RunOptions {
  SceneOptions scene;
  OutputOptions output;
  FilmOptions film;
  bool realtime = false;
  bool arm = false;
};

struct RunOutcome {
  RunSummary summary;
  bool stopped_early = false;
  std::string realtime_status;
  Failure trouble;  // why a session ended early; the outputs have the ticks before it
};

Failure check_arming(const RunOptions& options, const DeviceChoice& device) {
  if (!options.arm || device.hardware) return {};
  return usage_error("--arm: the simulator needs no arming; it is for --device ie2000 or ff");
}

Failure check_spin(const RunOptions& options, bool in_real_time) {
  const Result<double> spin_s = spin_seconds(options.scene.spin_us);
  if (!spin_s) return spin_s.error();
  if (*spin_s == 0.0 || in_real_time) return {};
  return usage_error("--spin: it needs --realtime or a device");
}

Failure check_realtime(const SceneOptions& options, const file::LoadedScene& loaded) {
  if (loaded.changes.empty() && loaded.first_recorded_tick == 0) return {};
  return usage_error(fmt::format(
      "{}: a part of a session, or one in which parameters changed; run it without --realtime",
      file::shown(options.scene)));
}

// All outputs of one run.
struct Outputs {
  RunOutputs files;
  FilmOutput film;
};

std::function<void(const Tick&)> tick_sink(Outputs& outputs) {
  if (!outputs.files.wants_ticks() && !outputs.film.wants_ticks()) return {};
  return [&outputs](const Tick& tick) {
    outputs.files.take(tick);
    if (outputs.film.wants_ticks()) outputs.film.take(tick);
  };
}

Result<RunOutcome> run_in_real_time(const RunOptions& options, const DeviceChoice& device,
                                    const Scene& scene, Outputs& all) {
  RunOutputs& outputs = all.files;
  const Result<RealtimeOutcome> result =
      run_realtime({.scene = scene,
                    .csv = options.output.csv,
                    .on_tick = tick_sink(all),
                    .device = device.hardware ? make_device(*device.hardware, scene) : nullptr,
                    .arm = options.arm,
                    .allow_no_realtime = options.scene.allow_no_realtime,
                    .allow_slow_device = options.scene.allow_slow_device,
                    .spin_s = options.scene.spin_us / kMicrosecondsPerSecond,
                    .show_progress = !options.output.quiet,
                    .stream = outputs.stream(),
                    .signals = outputs.columns().signals,
                    .ends = [&](const session::Snapshot&) { return outputs.reader_left(); }});
  if (!result) return result.error();
  outputs.keep_failure(result->recording_failure);
  return RunOutcome{result->summary, result->stopped_early, result->status, result->trouble};
}

RunOutcome run_headless(const RunOptions& options, const file::LoadedScene& loaded, Outputs& all) {
  RunOutputs& outputs = all.files;
  const HeadlessResult result =
      simulate_timed({.scene = loaded.scene,
                      .changes = loaded.changes,
                      .on_tick = tick_sink(all),
                      .signals = options.output.signals,
                      .should_stop = [&] { return outputs.reader_left(); },
                      .progress_label = loaded.scene.name,
                      .show_progress = !options.output.quiet});
  const std::uint64_t ticks =
      result.stopped_early ? result.summary.front().ticks : loaded.scene.tick_count();
  outputs.finish_recording(loaded, ticks, result.summary);
  return RunOutcome{result.summary, result.stopped_early, "", {}};
}

// A run that expects something expects its whole stream, too.
void expect_whole_stream(const OutputOptions& options, std::vector<Expectation>& expectations) {
  if (expectations.empty() || options.stream.path.empty()) return;
  if (std::ranges::count(expectations, kLostStreamSamples, &Expectation::key) > 0) return;
  const std::string key(kLostStreamSamples);
  expectations.push_back({key + "=0", key, "=", 0.0});
}

// Notes if the sidecar or its rows were changed since the recording.
void tell_edits(const std::string& sidecar, const file::LoadedScene& loaded) {
  if (loaded.edited) {
    tell(
        fmt::format("note: {} was changed since it was written: the run will differ from the "
                    "recorded session",
                    file::shown(sidecar)));
  }
  if (loaded.csv_sha256.empty() || !sidecar.ends_with(".toml")) return;
  const std::string csv = sidecar.substr(0, sidecar.size() - 4) + "csv";
  std::error_code missing;
  const std::uintmax_t bytes = std::filesystem::file_size(csv, missing);
  if (missing || file::sha256_of(csv, bytes) == loaded.csv_sha256) return;
  tell(
      fmt::format("note: {} has other rows than {} was written for: the run repeats the session, "
                  "not these rows",
                  file::shown(csv), file::shown(sidecar)));
}

int end_early(const RunOutcome& outcome, const Scene& scene, const std::string& csv) {
  return ended_early(fmt::format(" after {} of {} ticks{}", outcome.summary.front().ticks,
                                 scene.tick_count(),
                                 csv.empty() ? "" : "; " + file::shown(csv) + " holds these"));
}

// A session that ended early has no verdict, so its table is empty.
std::string table_of(const Scene& scene, const RunOutcome& outcome) {
  if (outcome.trouble) return "";
  const RunSummary& summary = outcome.summary;
  const bool hand_moves = hand_moves_in_tail(scene, summary, summary.front().duration_s);
  return summary_lines(summary, {outcome.realtime_status, hand_moves});
}

// The files of a run; the film before the stream, which cannot be undone.
Result<Outputs> open_outputs(const RunOptions& options, const file::LoadedScene& loaded,
                             bool on_simulator, bool in_real_time) {
  file::CsvColumns columns = file::csv_columns(on_simulator, loaded.scene.axes.size());
  if (options.output.signals) columns.signals = file::signal_columns(loaded.scene, loaded.changes);
  Result<FilmOutput> film = FilmOutput::open({.scene = options.scene,
                                              .film = options.film,
                                              .folder = options.output.frames,
                                              .in_real_time = in_real_time,
                                              .on_simulator = on_simulator,
                                              .show_progress = !options.output.quiet},
                                             loaded);
  if (!film) return film.error();
  Result<RunOutputs> files = RunOutputs::open(options.output, loaded,
                                              {.session_records = in_real_time,
                                               .in_real_time = in_real_time,
                                               .columns = std::move(columns)});
  if (!files) return files.error();
  return Outputs{std::move(*files), std::move(*film)};
}

// Writes the files, then draws the film, which takes longer. The exit status if all expectations
// hold.
Result<int> finish(const RunOutcome& outcome, const Scene& scene, Outputs& outputs) {
  const Failure failed = outputs.files.finish(scene, outcome.summary, table_of(scene, outcome));
  if (outcome.trouble) return *outcome.trouble;
  const Result<bool> drawn = outputs.film.finish();
  if (failed) return *failed;
  if (!drawn) return drawn.error();
  if (!*drawn) return ended_early("; the film was not drawn");
  return outputs.files.reader_left() ? kReaderLeft : 0;
}

Result<int> run(const RunOptions& options) {
  Result<std::vector<Expectation>> expectations = parse_expectations(options.output.expectations);
  if (!expectations) return expectations.error();
  if (Failure failed = check_outputs(options.output,
                                     {options.scene.scene, file_of_device(options.scene.device)}))
    return *failed;
  const Result<DeviceChoice> device = parse_device_choice(options.scene.device);
  if (!device) return device.error();
  if (Failure failed = check_arming(options, *device)) return *failed;
  if (Failure failed = check_plugin(options.scene)) return *failed;
  const bool in_real_time = options.realtime || device->hardware.has_value();
  if (Failure failed = check_spin(options, in_real_time)) return *failed;
  const Result<file::LoadedScene> loaded =
      device->hardware ? load(options.scene) : load_headless(options.scene);
  if (!loaded) return loaded.error();
  if (Failure failed = check_scene_files(options.output, *loaded)) return *failed;
  if (in_real_time) {
    if (Failure failed = check_realtime(options.scene, *loaded)) return *failed;
    expect_whole_stream(options.output, *expectations);
  }
  Result<Outputs> outputs = open_outputs(options, *loaded, !device->hardware, in_real_time);
  if (!outputs) return outputs.error();
  if (!options.output.quiet) tell_edits(options.scene.scene, *loaded);
  if (!options.output.quiet && !device->hardware) tell_difference(*loaded);

  catch_stop_signals();
  Result<RunOutcome> outcome = in_real_time
                                   ? run_in_real_time(options, *device, loaded->scene, *outputs)
                                   : Result(run_headless(options, *loaded, *outputs));
  if (!outcome) return outcome.error();
  if (in_real_time) outcome->summary.front().lost_stream_samples = outputs->files.end_stream();
  const bool interrupted = outcome->stopped_early && !outcome->trouble;
  if (interrupted && outputs->files.failure()) return *outputs->files.failure();
  if (interrupted && stop_signal() == 0) return kReaderLeft;
  if (interrupted) return end_early(*outcome, loaded->scene, options.output.csv);
  Result<int> finished = finish(*outcome, loaded->scene, *outputs);
  const int status = judge(*expectations, {&outcome->summary, 1});
  if (finished && *finished == 0) return status;
  return finished;
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
                "Run in real time, with the window's loop; a device always does");
  app->add_flag("--arm", options->arm,
                "Enable a device's force once its handle is outside the wall; without it the force "
                "stays off");
  add_csv_option(*app, options->output,
                 "Record every tick; run the sidecar FILE.toml to repeat it");
  add_plot_option(*app, options->output, "Draw the figure of the run");
  app->add_option("--wav", options->output.wav,
                  "Write the sound of the run: the handle's acceleration, one channel at 48 kHz")
      ->type_name("FILE.wav");
  add_film_options(*app, options->output.frames, options->film);
  add_stream_options(*app, options->output.stream);
  add_signals_option(*app, options->output.signals, "--csv, --stream and --plot");
  add_output_options(*app, options->output);
  return {app, [options] { return run(*options); }};
}

}  // namespace hapticwall::command
