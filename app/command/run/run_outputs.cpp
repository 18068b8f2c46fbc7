#include "app/command/run_outputs.h"

#include <fmt/format.h>

#include <utility>

#include "app/command/summary_fields.h"
#include "app/file/picture.h"
#include "app/ui/figure.h"

namespace hapticwall::command {
namespace {

file::RecordingMetadata metadata_of(const file::LoadedScene& loaded, std::uint64_t ticks) {
  file::RecordingMetadata metadata;
  metadata.device = "simulator";
  metadata.realtime_status = "not in real time: as fast as the machine can";
  metadata.first_tick = loaded.first_recorded_tick;
  metadata.session_ticks = ticks;
  for (const ScheduledChange& change : loaded.changes) {
    metadata.changes.push_back({change.tick, change.scene});
  }
  return metadata;
}

}  // namespace

Result<RunOutputs> RunOutputs::open(const OutputOptions& options, const file::LoadedScene& loaded,
                                    bool session_records) {
  if (!options.plot.empty() && loaded.scene.tick_count() > kMostPlottedTicks) {
    return Error{ErrorKind::kUsage, fmt::format("--plot: a figure shows at most {} ticks, this run "
                                                "has {}; --duration shortens it",
                                                kMostPlottedTicks, loaded.scene.tick_count())};
  }
  RunOutputs outputs;
  outputs.first_recorded_tick_ = loaded.first_recorded_tick;
  outputs.second_axis_ = loaded.scene.y.has_value();
  if (Failure failed = outputs.json_.open(options.json)) return *failed;
  if (Failure failed = outputs.plot_.open(options.plot)) return *failed;
  if (!options.csv.empty() && !session_records) {
    auto recording = file::RecordingWriter::create(
        options.csv, file::more_columns(true, loaded.scene.y.has_value()));
    if (!recording) return recording.error();
    if (Failure failed =
            (*recording)->note(loaded.scene, metadata_of(loaded, loaded.scene.tick_count()))) {
      return *failed;
    }
    outputs.recording_ = std::move(*recording);
  }
  return outputs;
}

void RunOutputs::take(const Sample& x, const Sample& y) {
  if (x.tick < first_recorded_tick_) return;
  if (recording_ && !failure_) failure_ = recording_->append(x, y);
  if (!plot_.is_open() || !file::is_finite(x) || !file::is_finite(y)) return;
  samples_.push_back(x);
  if (second_axis_) y_samples_.push_back(y);
}

Failure RunOutputs::finish_recording(const file::LoadedScene& loaded, std::uint64_t ticks) {
  if (failure_ || !recording_) return failure_;
  return recording_->finish(loaded.scene, metadata_of(loaded, ticks));
}

// Axis x, and at its right axis y where there is one.
Result<file::Picture> RunOutputs::draw(const Scene& scene) const {
  Result<file::Picture> x = ui::draw_figure(scene, samples_);
  if (!x || !scene.y) return x;
  Scene y_scene = second_axis(scene);
  y_scene.name += ", axis y";
  Result<file::Picture> y = ui::draw_figure(y_scene, y_samples_);
  if (!y) return y;
  return file::beside(*x, *y);
}

Failure RunOutputs::finish(const Scene& scene, const Summary& summary) {
  if (Failure failed = json_.write_whole(summary_json(summary))) return failed;
  if (!plot_.is_open()) return {};
  const Result<file::Picture> figure = draw(scene);
  if (!figure) return figure.error();
  const Result<std::string> bytes = file::encode_png(*figure);
  if (!bytes) return bytes.error();
  return plot_.write_whole(*bytes);
}

}  // namespace hapticwall::command
