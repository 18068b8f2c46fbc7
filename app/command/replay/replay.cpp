// hapticwall replay RECORDING.csv: shows a recording, or re-runs its hand under another algorithm.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/recorded_hand.h"
#include "app/command/replay_window.h"
#include "app/command/report/axes_metrics.h"
#include "app/command/report/expectation.h"
#include "app/command/report/progress.h"
#include "app/command/report/summary_table.h"
#include "app/command/report/terminal.h"
#include "app/command/run/run_outputs.h"
#include "app/command/signals.h"
#include "app/command/usage.h"
#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/recording/sidecar.h"
#include "app/file/text/text.h"
#include "app/session/hand_rerun.h"
#include "app/session/replay_session.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

struct RecordedRerun {
  file::RecordingReader& recording;
  const file::LoadedScene& loaded;  // of session::rerun_scene()
  std::string csv;                  // empty: no recording
  bool talks = true;                // shows progress and notes
};

// Re-runs the recording. After a stop signal, the CSV holds the ticks so far.
Result<session::RerunOutcome> rerun_recorded(const RecordedRerun& rerun, RunOutputs& outputs) {
  std::unique_ptr<file::RecordingWriter> writer;
  if (!rerun.csv.empty()) {
    auto created = file::RecordingWriter::create(rerun.csv, outputs.columns());
    if (!created) return created.error();
    writer = std::move(*created);
  }
  if (rerun.talks) tell_limits(rerun.recording.info());
  Progress progress(rerun.loaded.scene.name, rerun.talks);
  Failure failed;
  session::RerunOptions options;
  options.keep_going = [&](double fraction) {
    progress.show(fraction);
    return stop_signal() == 0 && !outputs.reader_left();
  };
  options.on_sample = [&](const Sample& sample) {
    if (writer && !failed) failed = writer->append({{sample}});
    if (outputs.wants_ticks()) outputs.take({{sample}});
  };
  auto outcome = session::rerun_hand(rerun.recording, rerun.loaded, options);
  if (!outcome) return outcome;
  if (writer && !failed)
    failed = writer->finish(rerun.loaded.scene, session::rerun_metadata(rerun.recording.info(),
                                                                        rerun.loaded, *outcome));
  outputs.keep_failure(std::move(failed));
  return outcome;
}

// A line of the summary: equal to the recording bit for bit, or the first tick and size of the
// difference.
std::string comparison_line(const session::RerunOutcome& outcome, double rate_hz) {
  std::string text = "equal to the recording, bit for bit";
  if (outcome.first_different_tick) {
    text = fmt::format(
        "differs from the recording from tick {} ({:.6g} s) on, by at most {:.3g} mm",
        *outcome.first_different_tick, static_cast<double>(*outcome.first_different_tick) / rate_hz,
        outcome.largest_distance_m * kMillimetresPerMetre);
  }
  return summary_line("re-run", text);
}

struct ReplayCommand {
  std::string recording;
  std::string algorithm;
  std::vector<std::string> settings;  // the KEY=VALUE texts of --set
  std::optional<double> speed;
  OutputOptions output;

  [[nodiscard]] bool reruns() const { return !algorithm.empty() || !settings.empty(); }
  [[nodiscard]] bool shows_no_window() const {
    return !output.csv.empty() || !output.json.empty() || !output.plot.empty() ||
           !output.stream.path.empty() || !output.stream.every.empty() ||
           !output.expectations.empty() || output.quiet;
  }
};

Failure check(const ReplayCommand& command) {
  if (!command.algorithm.empty()) {
    if (Failure failed = check_algorithm_name("--algorithm", command.algorithm)) return failed;
  }
  if (!command.output.csv.empty() && !command.reruns()) {
    return usage_error("--csv: it records a re-run; add --algorithm NAME");
  }
  if (command.speed && command.shows_no_window()) {
    return usage_error(
        "--speed: it is for the window; leave out --csv, --json, --plot, --stream, --expect "
        "and --quiet");
  }
  return check_outputs(command.output,
                       {command.recording, file::sidecar_path_of(command.recording)});
}

Result<std::unique_ptr<file::RecordingReader>> open_recording(const ReplayCommand& command) {
  Progress progress("reading", !command.output.quiet);
  return file::RecordingReader::open(command.recording, [&](double fraction) {
    progress.show(fraction);
    return stop_signal() == 0;
  });
}

void tell_notes(const ReplayCommand& command, const file::RecordingInfo& info) {
  if (command.output.quiet) return;
  for (const std::string& note : info.notes) {
    tell(fmt::format("note: {}: {}", file::shown(command.recording), note));
  }
}

struct Outcome {
  RunSummary summary;
  double end_s = 0.0;      // session time
  std::string comparison;  // an extra line after a re-run; else empty
  bool stopped_early = false;
};

SampleOrigin origin_of(const file::CsvColumns& columns) {
  if (columns.of_simulator()) return SampleOrigin::kSimulator;
  return columns.applied ? SampleOrigin::kDeviceWithForce : SampleOrigin::kDevice;
}

// The summary of the recorded rows.
Result<Outcome> summarise(file::RecordingReader& recording, RunOutputs& outputs) {
  const file::RecordingInfo& info = recording.info();
  const auto& diverged_at_tick = info.loaded.diverged_at_tick;
  const bool diverged =
      std::ranges::any_of(diverged_at_tick, [](const auto& tick) { return tick.has_value(); });
  // A run that diverged did not reach its tail.
  const std::uint64_t planned = diverged ? info.loaded.scene.tick_count() : recording.rows();
  AxesMetrics metrics(info.loaded.scene, planned, origin_of(info.scanned.columns));
  std::vector<Tick> rows(file::kRowsPerBlock);
  bool stopped = false;
  for (std::uint64_t row = 0; row < recording.rows() && !stopped;) {
    const Result<std::size_t> count = recording.read(row, rows);
    if (!count) return count.error();
    for (const Tick& tick : std::span(rows).first(*count)) {
      metrics.add(tick);
      if (outputs.wants_ticks()) outputs.take(tick);
    }
    row += *count;
    stopped = stop_signal() != 0 || outputs.reader_left();
  }
  metrics.diverge(diverged_at_tick);
  const double end_s =
      static_cast<double>(info.scanned.last_tick + 1) / info.loaded.scene.sampling.rate_hz;
  Outcome outcome{metrics.finish(), end_s, "", stopped};
  if (!info.has_sidecar) outcome.summary.front().algorithm = "unknown";
  return outcome;
}

Result<Outcome> rerun(const ReplayCommand& command, file::RecordingReader& recording,
                      const file::LoadedScene& loaded, RunOutputs& outputs) {
  const auto outcome =
      rerun_recorded({recording, loaded, command.output.csv, !command.output.quiet}, outputs);
  if (!outcome) return outcome.error();
  const double rate_hz = loaded.scene.sampling.rate_hz;
  return Outcome{{outcome->summary},
                 static_cast<double>(outcome->ticks) / rate_hz,
                 comparison_line(*outcome, rate_hz),
                 outcome->stopped_early};
}

// The scene of the rows, or of the re-run.
Result<file::LoadedScene> scene_of(const ReplayCommand& command, const file::RecordingInfo& info) {
  if (command.reruns()) return session::rerun_scene(info, command.algorithm, command.settings);
  file::LoadedScene loaded = info.loaded;
  loaded.first_recorded_tick = info.scanned.first_tick;
  return loaded;
}

std::string table_of(const Scene& scene, const Outcome& outcome) {
  const bool hand_moves = hand_moves_in_tail(scene, outcome.summary, outcome.end_s);
  return summary_lines(outcome.summary, {"", hand_moves}) + outcome.comparison;
}

// A re-run records the signals of its own algorithm if the recording has signals.
file::CsvColumns columns_of(const ReplayCommand& command, const file::RecordingInfo& info,
                            const file::LoadedScene& loaded) {
  file::CsvColumns columns = info.scanned.columns;
  if (!command.reruns()) return columns;
  columns.axes = 1;
  if (!columns.signals.empty())
    columns.signals = file::signal_columns(loaded.scene, loaded.changes);
  return columns;
}

// Replays without a window, for --json, --plot, ...
Result<int> run_headless(const ReplayCommand& command) {
  const auto expectations = parse_expectations(command.output.expectations);
  if (!expectations) return expectations.error();
  catch_stop_signals();
  const auto recording = open_recording(command);
  if (!recording && stop_signal() != 0) return ended_early("");
  if (!recording) return recording.error();
  tell_notes(command, (*recording)->info());
  const Result<file::LoadedScene> loaded = scene_of(command, (*recording)->info());
  if (!loaded) return loaded.error();
  if (Failure failed = check_scene_files(command.output, *loaded)) return *failed;
  Result<RunOutputs> outputs = RunOutputs::open(
      command.output, *loaded,
      {.session_records = true, .columns = columns_of(command, (*recording)->info(), *loaded)});
  if (!outputs) return outputs.error();

  const Result<Outcome> outcome = command.reruns() ? rerun(command, **recording, *loaded, *outputs)
                                                   : summarise(**recording, *outputs);
  if (!outcome) return outcome.error();
  if (outcome->stopped_early && outputs->failure()) return *outputs->failure();
  if (outcome->stopped_early && stop_signal() == 0) return kReaderLeft;
  if (outcome->stopped_early) return ended_early("");
  if (Failure failed =
          outputs->finish(loaded->scene, outcome->summary, table_of(loaded->scene, *outcome))) {
    return *failed;
  }
  const int status = judge(*expectations, {&outcome->summary, 1});
  return outputs->reader_left() ? kReaderLeft : status;
}

Result<int> open_window(const ReplayCommand& command, const session::OpenWindow& open) {
  auto recording = open_recording(command);
  if (!recording) return recording.error();
  tell_notes(command, (*recording)->info());
  ReplayWindow window;
  if (command.reruns()) {
    auto laid_over = session::rerun_as_overlay(**recording, command.algorithm, command.settings);
    if (!laid_over) return laid_over.error();
    window.overlay = std::move(*laid_over);
  }
  window.speed = command.speed.value_or(window.speed);
  return status_after_window(run_replay_window(std::move(*recording), std::move(window), open));
}

Result<int> replay(const ReplayCommand& command, const session::OpenWindow& open) {
  if (Failure failed = check(command)) return *failed;
  return command.shows_no_window() ? run_headless(command) : open_window(command, open);
}

}  // namespace

Command add_replay(CLI::App& program, session::OpenWindow open) {
  const auto command = std::make_shared<ReplayCommand>();
  CLI::App* app = program.add_subcommand(
      "replay", "Show a recording; --algorithm re-runs its hand under another algorithm");
  app->add_option("RECORDING", command->recording, "NAME.csv, or NAME.csv.partial")
      ->type_name("")
      ->required();
  app->add_option("--algorithm", command->algorithm,
                  "Re-run the recorded hand under this algorithm, or plug-in ./MINE.so, over the "
                  "recording")
      ->type_name("NAME")
      ->transform(loads_plugin());
  app->add_option("--set", command->settings,
                  "Re-run it with a changed key of the scene, e.g. wall.stiffness_n_per_m=5000 "
                  "(repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app->add_option("--speed", command->speed, "Speed of the replay, 0.01 to 100")
      ->type_name("X")
      ->check(is_number_within(session::kMinReplaySpeed, session::kMaxReplaySpeed));
  add_csv_option(*app, command->output, "Record the re-run, without a window");
  add_plot_option(*app, command->output, "Draw the figure, without a window");
  add_stream_options(*app, command->output.stream);
  add_output_options(*app, command->output);
  return {app, [command, open = std::move(open)] { return replay(*command, open); }};
}

}  // namespace hapticwall::command
