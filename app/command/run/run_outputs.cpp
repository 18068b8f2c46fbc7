#include "app/command/run/run_outputs.h"

#include <fmt/format.h>

#include <utility>

#include "app/command/common_options.h"
#include "app/command/report/summary_fields.h"
#include "app/draw/figure/figure.h"
#include "app/sound/signal/wav.h"
#include "core/result.h"

namespace hapticwall::command {
namespace {

Failure check_lengths(const OutputOptions& options, const Scene& scene) {
  if (!options.plot.empty() && scene.tick_count() > kMaxPlottedTicks) {
    return usage_error(fmt::format(
        "--plot: a figure shows at most {} ticks, this run has {}; --duration shortens it",
        kMaxPlottedTicks, scene.tick_count()));
  }
  if (options.wav.empty() || scene.duration_s <= kMaxSoundS) return {};
  return usage_error(
      fmt::format("--wav: a sound file has at most {:g} s, this run has {:g} s; --duration "
                  "shortens it",
                  kMaxSoundS, scene.duration_s));
}

// True if no output is of use after the stream's reader has left.
Result<bool> only_streams(const OutputOptions& options) {
  if (!options.csv.empty() || !options.json.empty() || !options.plot.empty() ||
      !options.wav.empty() || !options.frames.empty() || !options.expectations.empty()) {
    return false;
  }
  return options.quiet ? true : is_standard_output(options.stream.path);
}

}  // namespace

Result<RunOutputs> RunOutputs::open(const OutputOptions& options, const file::LoadedScene& loaded,
                                    const TickOrigin& origin) {
  if (Failure failed = check_lengths(options, loaded.scene)) return *failed;
  RunOutputs outputs;
  outputs.columns_ = origin.columns;
  outputs.first_recorded_tick_ = loaded.first_recorded_tick;
  OutputOptions without_csv = options;
  without_csv.csv.clear();
  Result<OutputFiles> files = OutputFiles::open(without_csv);
  if (!files) return files.error();
  outputs.files_ = std::move(*files);
  if (!options.wav.empty()) {
    if (Failure failed = outputs.wav_.open(options.wav)) return *failed;
    outputs.sound_.emplace(loaded.scene.sampling.rate_hz, sound::kFileRateHz,
                           origin.columns.of_simulator());
  }
  if (!options.csv.empty() && !origin.session_records) {
    auto recording = file::RecordingWriter::create(options.csv, origin.columns);
    if (!recording) return recording.error();
    if (Failure failed = (*recording)
                             ->note(loaded.scene, file::headless_metadata(
                                                      loaded, loaded.scene.tick_count(), {}))) {
      return *failed;
    }
    outputs.recording_ = std::move(*recording);
  }
  if (Failure failed = outputs.open_stream(options, origin)) return *failed;
  return outputs;
}

// Opened last, because a stream that somebody reads cannot be undone.
Failure RunOutputs::open_stream(const OutputOptions& options, const TickOrigin& origin) {
  const Result<bool> only = only_streams(options);
  if (!only) return only.error();
  only_streams_ = *only;
  file::StreamOptions how;
  how.waits = !origin.in_real_time;
  how.tells_leaving = !only_streams_;
  Result<std::shared_ptr<file::SampleStream>> stream =
      command::open_stream(options.stream, std::move(how));
  if (!stream) return stream.error();
  stream_ = std::move(*stream);
  if (stream_ && stream_->on_standard_output()) {
    if (Failure failed = files_.leave_standard_output()) return failed;
  }
  if (stream_ && !origin.in_real_time) feed_ = stream_->begin(origin.columns);
  return {};
}

void RunOutputs::take(const Tick& tick) {
  if (tick.x().tick < first_recorded_tick_) return;
  if (recording_ && !failure_) failure_ = recording_->append(tick);
  if (feed_) stream_->take(*feed_, tick);
  if (sound_) sound_->take(tick, heard_);
  if (!files_.wants_plot() || !is_finite(tick)) return;
  for (std::size_t axis = 0; axis < tick.count; ++axis) {
    samples_[axis].push_back(tick.axes[axis]);
  }
}

bool RunOutputs::reader_left() const {
  if (!stream_) return false;
  stream_->flush();
  return only_streams_ && stream_->reader_left();
}

void RunOutputs::finish_recording(const file::LoadedScene& loaded, std::uint64_t ticks,
                                  const RunSummary& summary) {
  if (failure_ || !recording_) return;
  failure_ = recording_->finish(loaded.scene, file::headless_metadata(loaded, ticks, summary));
}

// The axes side by side, x on the left; or one below the other, on narrow paper.
Result<file::Picture> RunOutputs::draw(const Scene& scene, const draw::Paper& paper) const {
  file::Picture all;
  const double beside_mm = paper.width_mm / static_cast<double>(scene.axes.size());
  const bool stacked = beside_mm < draw::kMinWidthMm;
  const draw::Paper each{stacked ? paper.width_mm : beside_mm, paper.ink};
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const Scene axis = axis_scene(scene, i);
    Result<file::Picture> picture =
        draw::draw_figure(axis, samples_.at(i), each, file::signal_names(columns_), i);
    if (!picture) return picture;
    if (i == 0) {
      all = std::move(*picture);
    } else {
      all = stacked ? file::below(all, *picture) : file::beside(all, *picture);
    }
  }
  return all;
}

Failure RunOutputs::write_sound() {
  if (!sound_) return {};
  sound_->finish(heard_);
  const Result<std::string> bytes = sound::encode_wav(heard_);
  return bytes ? wav_.write_whole(*bytes) : bytes.error();
}

std::optional<std::uint64_t> RunOutputs::end_stream() {
  if (!stream_) return std::nullopt;
  stream_->finish();
  if (!failure_) failure_ = stream_->failure();
  return stream_->lost();
}

Failure RunOutputs::finish(const Scene& scene, const RunSummary& summary, std::string table) {
  static_cast<void>(end_stream());
  Failure failed = files_.write({"", summary_json(summary), std::move(table)},
                                [&](const draw::Paper& paper) { return draw(scene, paper); });
  Failure unheard = write_sound();
  if (!failed) failed = std::move(unheard);
  return failure_ ? failure_ : failed;
}

}  // namespace hapticwall::command
