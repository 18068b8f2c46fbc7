#include "app/command/replay/replay_rerun.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "app/command/report/progress.h"
#include "app/command/report/summary_table.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/text/text.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

file::RecordingMetadata metadata_of(const RecordedRerun& rerun,
                                    const runtime::RerunOutcome& outcome) {
  const std::string name =
      std::filesystem::path(rerun.recording.info().csv_path).filename().string();
  file::RecordingMetadata metadata;
  metadata.device = "simulator";
  metadata.realtime_status = "not in real time: the hand of " + file::shown(name) + ", re-run";
  metadata.first_tick = rerun.loaded.first_recorded_tick;
  metadata.session_ticks = outcome.ticks;
  metadata.diverged_at_tick = divergence_of({outcome.summary});
  if (outcome.pointer_led) {
    metadata.repeatable = false;
    metadata.not_repeatable_because =
        "the pointer led the hand in " + file::shown(name) + "; `hapticwall replay` repeats it";
  }
  for (const ScheduledChange& change : rerun.loaded.changes) {
    if (change.tick < outcome.ticks) metadata.changes.push_back(change);
  }
  return metadata;
}

// What the re-run leaves out.
void tell_limits(const file::RecordingInfo& recording) {
  const std::uint64_t first_tick = recording.scanned.first_tick;
  if (first_tick > 0 && !recording.loaded.not_repeatable_because.empty()) {
    tell(fmt::format(
        "note: {} begins at tick {} of its session; the pointer's earlier motion is not recorded",
        file::shown(recording.csv_path), first_tick));
  }
  if (recording.loaded.scene.two_axes()) {
    tell("note: the recording has two axes; the re-run covers axis x only");
  }
}

file::LoadedScene under(file::LoadedScene loaded, const ComparedAlgorithm& row) {
  const std::size_t index = row.settings.index;
  const auto form = find_algorithm_parameter(algorithms()[index].forms_key);
  loaded.scene.algorithm = row.settings;
  for (ScheduledChange& change : loaded.changes) {
    change.scene.algorithm.index = index;
    if (form) change.scene.algorithm.values[*form] = row.settings.values[*form];
  }
  return loaded;
}

}  // namespace

Result<runtime::RerunOutcome> rerun_recorded(const RecordedRerun& rerun, RunOutputs& outputs) {
  std::unique_ptr<file::RecordingWriter> writer;
  if (!rerun.csv.empty()) {
    auto created = file::RecordingWriter::create(rerun.csv, file::CsvColumns{});
    if (!created) return created.error();
    writer = std::move(*created);
  }
  if (rerun.talks) tell_limits(rerun.recording.info());
  Progress progress(rerun.loaded.scene.name, rerun.talks);
  Failure failed;
  runtime::RerunOptions options;
  options.keep_going = [&](double fraction) {
    progress.show(fraction);
    return stop_signal() == 0;
  };
  options.on_sample = [&](const Sample& sample) {
    if (writer && !failed) failed = writer->append({{sample}});
    if (outputs.wants_ticks()) outputs.take({{sample}});
  };
  auto outcome = runtime::rerun_hand(rerun.recording, rerun.loaded, options);
  if (!outcome) return outcome;
  if (writer && !failed) failed = writer->finish(rerun.loaded.scene, metadata_of(rerun, *outcome));
  outputs.keep_failure(std::move(failed));
  return outcome;
}

Result<OpenedRecording> open_for_rerun(const SceneOptions& options, bool talks) {
  if (!options.duration.empty()) {
    return usage_error("--duration: a recording lasts as long as its rows; it takes a scene");
  }
  auto reader = file::RecordingReader::open(options.scene);
  if (!reader) return reader.error();
  const file::RecordingInfo& info = (*reader)->info();
  auto loaded = runtime::rerun_scene(info, options.algorithm, options.settings);
  if (!loaded) return loaded.error();
  if (talks) {
    const std::string name = file::shown(options.scene);
    for (const std::string& note : info.notes) tell(fmt::format("note: {}: {}", name, note));
    tell(fmt::format("note: {}: its recorded hand is re-run", name));
    tell_limits(info);
  }
  return OpenedRecording{std::move(*reader), std::move(*loaded)};
}

Result<std::optional<Summary>> rerun_row(OpenedRecording& recording, const ComparedAlgorithm& row,
                                         const std::function<void(const Tick&)>& on_tick,
                                         Progress& progress) {
  runtime::RerunOptions options;
  options.keep_going = [&](double fraction) {
    progress.show(fraction);
    return stop_signal() == 0;
  };
  if (on_tick) options.on_sample = [&](const Sample& sample) { on_tick({{sample}}); };
  auto outcome = runtime::rerun_hand(*recording.reader, under(recording.loaded, row), options);
  if (!outcome) return outcome.error();
  if (outcome->stopped_early) return std::optional<Summary>();
  return std::optional(std::move(outcome->summary));
}

std::string comparison_line(const runtime::RerunOutcome& outcome, double rate_hz) {
  std::string text = "equal to the recording, bit for bit";
  if (outcome.first_different_tick) {
    text = fmt::format(
        "differs from the recording from tick {} ({:.6g} s) on, by at most {:.3g} mm",
        *outcome.first_different_tick, static_cast<double>(*outcome.first_different_tick) / rate_hz,
        outcome.largest_distance_m * kMillimetresPerMetre);
  }
  return summary_line("re-run", text);
}

}  // namespace hapticwall::command
