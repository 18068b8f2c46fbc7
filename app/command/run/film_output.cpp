#include "app/command/run/film_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <utility>

#include "app/command/report/progress.h"
#include "app/command/run/headless.h"
#include "app/command/signals.h"
#include "app/file/picture.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::command {
namespace {

std::string picture_name(std::uint64_t index) { return fmt::format("{:05}.png", index); }

draw::FilmScene film_scene(const Scene& scene, std::size_t axis, std::uint64_t from_tick) {
  std::string name = algorithm_label(scene.algorithm);
  if (name == "none") name = "no algorithm";
  if (scene.two_axes()) name += axis == 0 ? ", axis x" : ", axis y";
  return {from_tick, axis_scene(scene, axis), std::move(name)};
}

// A run without ticks.
draw::FilmRun empty_run(const Scene& scene, std::span<const ScheduledChange> changes,
                        std::size_t axis, bool knows_truth) {
  draw::FilmRun run{{film_scene(scene, axis, 0)},
                    draw::SampleHistory(scene.tick_count(), scene.axes[axis].device.encoder_m),
                    knows_truth};
  for (const ScheduledChange& change : changes)
    run.scenes.push_back(film_scene(change.scene, axis, change.tick));
  return run;
}

// Ticks after the run has diverged are left out.
void take_sample(draw::FilmRun& run, Sample sample) {
  if (!is_finite(sample)) return;
  if (!run.knows_truth) sample.truth.position_m = sample.position_m;
  run.history.push(sample);
}

Failure check_beside(const FilmRequest& request, const file::LoadedScene& loaded) {
  if (Failure failed = check_algorithm_name("--beside", request.film.beside)) return failed;
  if (request.in_real_time)
    return usage_error("--beside: it needs the simulator, and a run without --realtime");
  if (!loaded.changes.empty())
    return usage_error("--beside: the parameters of this session change; choose a scene");
  if (loaded.scene.two_axes())
    return usage_error("--beside: this scene has two axes, which stand side by side; leave it out");
  return {};
}

Result<Scene> scene_beside(const FilmRequest& request, const file::LoadedScene& loaded) {
  if (Failure failed = check_beside(request, loaded)) return *failed;
  SceneOptions options = request.scene;
  options.algorithm = request.film.beside;
  Result<file::LoadedScene> other = load_headless(options);
  if (!other) return other.error();
  return std::move(other->scene);
}

Failure check_ticks(const Scene& scene) {
  if (scene.tick_count() <= kMaxPlottedTicks) return {};
  return usage_error(fmt::format(
      "--frames: a film shows at most {} ticks, this run has {}; --duration shortens it",
      kMaxPlottedTicks, scene.tick_count()));
}

}  // namespace

Result<FilmOutput> FilmOutput::open(const FilmRequest& request, const file::LoadedScene& loaded) {
  FilmOutput output;
  const Result<draw::FilmSettings> settings =
      film_settings(request.folder, request.film, loaded.scene.duration_s);
  if (!settings) return settings.error();
  output.settings_ = *settings;
  if (request.folder.empty()) return output;
  if (Failure failed = check_ticks(loaded.scene)) return *failed;
  if (!request.film.beside.empty()) {
    Result<Scene> beside = scene_beside(request, loaded);
    if (!beside) return beside.error();
    output.beside_ = std::move(*beside);
  }
  // A trial: made again when the other files are written, because a figure may end the program.
  const Result<file::AtomicFolder> folder = file::AtomicFolder::create(request.folder);
  if (!folder) return folder.error();
  output.folder_ = request.folder;
  output.first_recorded_tick_ = loaded.first_recorded_tick;
  output.show_progress_ = request.show_progress;
  for (std::size_t axis = 0; axis < loaded.scene.axes.size(); ++axis)
    output.runs_.push_back(empty_run(loaded.scene, loaded.changes, axis, request.on_simulator));
  return output;
}

void FilmOutput::take(const Tick& tick) {
  if (tick.x().tick < first_recorded_tick_) return;
  for (std::size_t axis = 0; axis < runs_.size(); ++axis) take_sample(runs_[axis], tick.axes[axis]);
}

// False: a stop signal has ended it.
Result<bool> FilmOutput::run_beside() {
  if (!beside_) return true;
  runs_.push_back(empty_run(*beside_, {}, 0, true));
  const HeadlessResult result =
      simulate_timed({.scene = *beside_,
                      .changes = {},
                      .on_tick = [&](const Tick& tick) { take_sample(runs_.back(), tick.x()); },
                      .should_stop = {},
                      .progress_label = runs_.back().scenes.front().name,
                      .show_progress = show_progress_});
  return !result.stopped_early;
}

// A run that diverges ends early, and a part of a recording begins late.
Failure FilmOutput::fit_to_ticks() {
  for (const draw::FilmRun& run : runs_) {
    if (run.history.empty()) return usage_error("--frames: the run has no tick");
    settings_.from_s = std::max(settings_.from_s, run.history.oldest_time_s());
  }
  double end_s = 0.0;
  for (const draw::FilmRun& run : runs_) end_s = std::max(end_s, run.history.newest_time_s());
  const double period_s = runs_.front().scenes.front().scene.sampling.period_s();
  settings_.to_s = std::min(settings_.to_s, end_s + period_s);
  if (settings_.from_s < settings_.to_s) return {};
  return usage_error(fmt::format("--frames-from {:g}: the run ended at {:g} s; begin earlier",
                                 settings_.from_s, end_s));
}

// A picture is encoded while the next one is drawn.
Result<bool> FilmOutput::draw_pictures(file::AtomicFolder& folder) {
  draw::Film film(std::move(runs_), settings_);
  Progress progress("film", show_progress_);
  std::future<Result<std::string>> encoded;
  for (std::uint64_t i = 0; i <= film.count(); ++i) {
    if (stop_signal() != 0) return false;
    std::future<Result<std::string>> last = std::move(encoded);
    if (i < film.count()) {
      Result<file::Picture> picture = film.draw(i);
      if (!picture) return picture.error();
      encoded = std::async(std::launch::async,
                           [drawn = std::move(*picture)] { return file::encode_png(drawn); });
    }
    if (!last.valid()) continue;
    const Result<std::string> bytes = last.get();
    if (!bytes) return bytes.error();
    if (Failure failed = folder.write(picture_name(i - 1), *bytes)) return *failed;
    progress.show(static_cast<double>(i) / static_cast<double>(film.count()));
  }
  return true;
}

Result<bool> FilmOutput::finish() {
  if (folder_.empty()) return true;
  Result<bool> done = run_beside();
  if (!done || !*done) return done;
  if (Failure failed = fit_to_ticks()) return *failed;
  Result<file::AtomicFolder> folder = file::AtomicFolder::create(folder_);
  if (!folder) return folder.error();
  done = draw_pictures(*folder);
  if (!done || !*done) return done;
  if (Failure failed = folder->commit()) return *failed;
  return true;
}

}  // namespace hapticwall::command
