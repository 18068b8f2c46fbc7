#include "app/python/runs.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>
#include <utility>

#include "app/python/interruptible.h"
#include "app/session/hand_rerun.h"
#include "core/run/simulate.h"
#include "core/units.h"

namespace hapticwall::python {
namespace {

// Adds the pace of the run as a whole, by a wall clock.
void add_pace(RunSummary& run, std::chrono::duration<double> elapsed) {
  Summary& summary = run.front();
  if (summary.ticks == 0 || elapsed.count() <= 0.0) return;
  summary.ns_per_tick =
      elapsed.count() * kNanosecondsPerSecond / static_cast<double>(summary.ticks);
  summary.simulated_seconds_per_second = summary.duration_s / elapsed.count();
}

void simulate_into(RunBox& box, const StopQuestion& should_stop) {
  constexpr std::uint64_t kMaxReserved = std::uint64_t{1} << 20U;
  const file::LoadedScene& loaded = box.scene.loaded();
  box.rows.samples.reserve(std::min(loaded.scene.tick_count(), kMaxReserved) *
                           loaded.scene.axes.size());
  const auto start = std::chrono::steady_clock::now();
  const AxesResult result =
      simulate_axes(loaded.scene, {.on_tick =
                                       [&](const Tick& tick) {
                                         if (tick.x().tick >= loaded.first_recorded_tick)
                                           box.rows.append(tick);
                                       },
                                   .should_stop = should_stop,
                                   .changes = loaded.changes});
  box.summary = summaries_of(result);
  add_pace(box.summary, std::chrono::steady_clock::now() - start);
  box.metadata = file::headless_metadata(loaded, loaded.scene.tick_count(), box.summary);
}

}  // namespace

void RunBox::save(const std::string& path) const {
  auto writer = value_or_raise(file::RecordingWriter::create(path, rows.columns));
  const std::size_t axes = rows.columns.axes;
  Failure failed;
  for (std::size_t i = 0; i < rows.samples.size() && !failed; i += axes) {
    Tick tick;
    tick.count = rows.columns.axes;
    std::copy_n(rows.samples.begin() + static_cast<std::ptrdiff_t>(i), axes, tick.axes.begin());
    failed = writer->append(tick);
  }
  if (!failed) failed = writer->finish(scene.loaded().scene, metadata);
  if (failed) raise(*failed);
}

RecordingBox::RecordingBox(const std::string& path)
    : reader_(value_or_raise(interruptibly([&](const StopQuestion& should_stop) {
        return file::RecordingReader::open(path, [&](double) { return !should_stop(); });
      }))) {}

const Rows& RecordingBox::rows() {
  if (rows_) return *rows_;
  Rows rows{info().scanned.columns, {}};
  rows.samples.reserve(reader_->rows() * rows.columns.axes);
  std::vector<Tick> ticks(file::kRowsPerBlock);
  for (std::uint64_t row = 0; row < reader_->rows();) {
    const std::size_t count = value_or_raise(reader_->read(row, ticks));
    for (const Tick& tick : std::span(ticks).first(count)) rows.append(tick);
    row += count;
  }
  return rows_.emplace(std::move(rows));
}

SceneBox RecordingBox::scene() {
  file::LoadedScene loaded = value_or_raise(session::rerun_scene(info(), "", {}));
  if (!loaded.changes.empty())
    raise(usage_error("parameters change in this recording; rerun() repeats them"));
  file::LoadedScene recorded;
  recorded.scene = value_or_raise(session::recorded_scene(*reader_, loaded));
  return SceneBox(std::move(recorded));
}

RunBox RecordingBox::rerun(const std::string& algorithm,
                           const std::vector<std::string>& overrides) {
  RunBox box{
      SceneBox(value_or_raise(session::rerun_scene(info(), algorithm, overrides))), {}, {}, {}, {}};
  const auto outcome = value_or_raise(interruptibly([&](const StopQuestion& should_stop) {
    return session::rerun_hand(
        *reader_, box.scene.loaded(),
        {.on_sample = [&](const Sample& sample) { box.rows.append({{sample}}); },
         .keep_going = [&](double) { return !should_stop(); }});
  }));
  box.summary = {outcome.summary};
  box.metadata = session::rerun_metadata(info(), box.scene.loaded(), outcome);
  box.first_different_tick = outcome.first_different_tick;
  return box;
}

RunBox run(const SceneBox& scene) {
  const std::size_t axes = scene.loaded().scene.axes.size();
  RunBox box{scene, {}, {file::csv_columns(true, axes), {}}, {}, {}};
  interruptibly([&](const StopQuestion& should_stop) { simulate_into(box, should_stop); });
  return box;
}

}  // namespace hapticwall::python
