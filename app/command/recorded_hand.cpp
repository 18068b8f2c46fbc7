#include "app/command/recorded_hand.h"

#include <fmt/format.h>

#include <utility>

#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

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

Result<OpenedRecording> open_for_rerun(const SceneOptions& options, bool talks) {
  if (!options.duration.empty()) {
    return usage_error("--duration: a recording lasts as long as its rows; it takes a scene");
  }
  auto reader = file::RecordingReader::open(options.scene);
  if (!reader) return reader.error();
  const file::RecordingInfo& info = (*reader)->info();
  auto loaded = session::rerun_scene(info, options.algorithm, options.settings);
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
  session::RerunOptions options;
  options.keep_going = [&](double fraction) {
    progress.show(fraction);
    return stop_signal() == 0;
  };
  if (on_tick) options.on_sample = [&](const Sample& sample) { on_tick({{sample}}); };
  auto outcome = session::rerun_hand(*recording.reader, under(recording.loaded, row), options);
  if (!outcome) return outcome.error();
  if (outcome->stopped_early) return std::optional<Summary>();
  return std::optional(std::move(outcome->summary));
}

}  // namespace hapticwall::command
