#include "app/session/hand_rerun.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/recording/sidecar.h"
#include "app/file/text/text.h"
#include "app/session/recorded_hand.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"
#include "core/run/metrics.h"
#include "core/run/stepped_axis.h"

namespace hapticwall::session {
namespace {

constexpr std::uint64_t kTicksPerQuestion = 1024;

Failure check_overrides(const Scene& recorded, const Scene& wanted) {
  const auto refused = [](std::string_view key) {
    return usage_error(fmt::format("--set {}: that is as it was recorded; `run` takes it", key));
  };
  if (wanted.sampling.rate_hz != recorded.sampling.rate_hz) return refused("sampling.rate_hz");
  if (wanted.duration_s != recorded.duration_s) return refused("duration_s");
  if (wanted.x().hand.has_value() != recorded.x().hand.has_value()) return refused("hand");
  if (wanted.x().hand && (wanted.x().hand->path != recorded.x().hand->path ||
                          wanted.x().hand->follows_mouse != recorded.x().hand->follows_mouse)) {
    return refused("hand.path");
  }
  return {};
}

// Compares what a simulator records, except hand_force_n (see hand_rerun.h).
bool same_numbers(const Sample& a, const Sample& b) {
  return all_columns(a, b, [](const SampleColumn& column, const auto& x, const auto& y) {
    return column.group == ColumnGroup::kDevice ||
           column.member == SampleMember(&PlantTruth::hand_force_n) || x == y;
  });
}

// Axis x of the rows in order, read a block at a time.
class RowStream {
 public:
  explicit RowStream(file::RecordingReader& recording) : recording_(recording) {}

  // Null at the end and after a failure.
  const Sample* next() {
    if (at_ == count_) {
      const auto count = recording_.read(row_, ticks_);
      if (!count) failure_ = count.error();
      count_ = count ? *count : 0;
      row_ += count_;
      at_ = 0;
      if (count_ == 0) return nullptr;
    }
    return &ticks_[at_++].axes.front();
  }
  [[nodiscard]] const Failure& failure() const { return failure_; }

 private:
  file::RecordingReader& recording_;
  std::vector<Tick> ticks_{file::kRowsPerBlock};
  std::uint64_t row_ = 0;
  std::size_t at_ = 0;
  std::size_t count_ = 0;
  Failure failure_;
};

Result<std::vector<double>> recorded_path(file::RecordingReader& recording) {
  std::vector<double> positions_m;
  positions_m.reserve(recording.rows());
  RowStream rows(recording);
  while (const Sample* row = rows.next()) positions_m.push_back(row->truth.hand_path_m);
  if (rows.failure()) return *rows.failure();
  return positions_m;
}

class Rerun {
 public:
  Rerun(file::RecordingReader& recording, const file::LoadedScene& loaded,
        const RerunOptions& options, std::vector<double> positions_m)
      : recording_(recording.info()),
        loaded_(loaded),
        options_(options),
        rows_(recording),
        end_tick_(recording_.scanned.last_tick + 1),
        axis_(loaded.scene),
        hand_(loaded.scene, recording_.scanned.first_tick, std::move(positions_m)),
        metrics_(loaded.scene, end_tick_, SampleOrigin::kSimulator) {}

  Result<RerunOutcome> run() {
    while (axis_.tick() < end_tick_ && pass_tick()) {
    }
    // The tick after the last row, as a headless run checks it.
    if (axis_.tick() == end_tick_ && axis_.diverged()) metrics_.diverge(end_tick_);
    if (rows_.failure()) return *rows_.failure();
    outcome_.summary = metrics_.finish();
    outcome_.ticks = outcome_.summary.ticks;
    outcome_.pointer_led = hand_.has_led();
    return outcome_;
  }

 private:
  bool pass_tick() {
    const std::uint64_t tick = axis_.tick();
    if (tick % kTicksPerQuestion == 0 && options_.keep_going &&
        !options_.keep_going(static_cast<double>(tick) / static_cast<double>(end_tick_))) {
      outcome_.stopped_early = true;
      return false;
    }
    apply_changes(tick);
    const Sample* sample = axis_.compute();
    if (sample == nullptr) {
      metrics_.diverge(tick);
      return false;
    }
    metrics_.add(*sample);
    if (tick >= recording_.scanned.first_tick && !tell(*sample)) return false;
    hand_.lead(axis_.plant());
    axis_.advance();
    return true;
  }

  bool tell(const Sample& sample) {
    if (options_.on_sample) options_.on_sample(sample);
    const Sample* row = rows_.next();
    if (row == nullptr) return false;
    if (!outcome_.first_different_tick && !same_numbers(sample, *row)) {
      outcome_.first_different_tick = sample.tick;
    }
    outcome_.largest_distance_m = std::max(
        outcome_.largest_distance_m, std::abs(sample.truth.position_m - row->truth.position_m));
    return true;
  }

  void apply_changes(std::uint64_t tick) {
    while (change_ < loaded_.changes.size() && loaded_.changes[change_].tick <= tick)
      axis_.change(loaded_.changes[change_++].scene);
  }

  const file::RecordingInfo& recording_;
  const file::LoadedScene& loaded_;
  const RerunOptions& options_;
  RowStream rows_;
  std::uint64_t end_tick_;
  SteppedAxis axis_;
  RecordedHand hand_;
  Metrics metrics_;
  std::size_t change_ = 0;
  RerunOutcome outcome_;
};

}  // namespace

Failure check_rerun(const file::RecordingInfo& recording) {
  const std::string name = file::shown(recording.csv_path);
  if (!recording.of_simulator()) {
    return usage_error(name +
                       ": a person's hand cannot be re-run; only a recording of the "
                       "simulator has its hand's path in it");
  }
  if (!recording.has_sidecar) {
    return usage_error(
        fmt::format("{}: cannot be re-run without its scene: {}", name, recording.notes.front()));
  }
  if (recording.scanned.missing_rows > 0) {
    return usage_error(
        fmt::format("{}: cannot be re-run: {} rows are missing, and the hand's path "
                    "with them",
                    name, recording.scanned.missing_rows));
  }
  const auto couples = [](const ScheduledChange& change) { return couples_axes(change.scene); };
  if (couples_axes(recording.loaded.scene) ||
      std::ranges::any_of(recording.loaded.changes, couples)) {
    return usage_error(name +
                       ": cannot be re-run: its axes need each other at every tick, and a re-run "
                       "is of axis x alone; 'run' repeats both by the sidecar");
  }
  return {};
}

Result<file::LoadedScene> rerun_scene(const file::RecordingInfo& recording,
                                      const std::string& algorithm,
                                      const std::vector<std::string>& overrides) {
  if (Failure failed = check_rerun(recording)) return *std::move(failed);
  file::LoadedScene wanted = recording.loaded;
  if (!overrides.empty()) {
    if (!wanted.changes.empty()) {
      return usage_error(fmt::format("--set: parameters change {} times in {}, which would undo it",
                                     wanted.changes.size(), file::shown(recording.csv_path)));
    }
    auto loaded = file::load_scene(file::find_sidecar(recording.csv_path), overrides);
    if (!loaded) return loaded;
    if (Failure failed = check_overrides(wanted.scene, loaded->scene)) return *std::move(failed);
    wanted = std::move(*loaded);
  }
  wanted.first_recorded_tick = recording.scanned.first_tick;
  // Only axis x is re-run.
  wanted.scene.axes.resize(1);
  for (ScheduledChange& change : wanted.changes) change.scene.axes.resize(1);
  if (algorithm.empty()) return wanted;
  const std::optional<std::size_t> index = find_algorithm(algorithm);
  if (!index) return usage_error("no algorithm is called " + file::in_quotes(algorithm));
  wanted.scene.algorithm.index = *index;
  for (ScheduledChange& change : wanted.changes) change.scene.algorithm.index = *index;
  return wanted;
}

Result<RerunOutcome> rerun_hand(file::RecordingReader& recording, const file::LoadedScene& scene,
                                const RerunOptions& options) {
  Result<std::vector<double>> positions_m = recorded_path(recording);
  if (!positions_m) return positions_m.error();
  return Rerun(recording, scene, options, std::move(*positions_m)).run();
}

file::RecordingMetadata rerun_metadata(const file::RecordingInfo& recording,
                                       const file::LoadedScene& scene,
                                       const RerunOutcome& outcome) {
  const std::string name =
      file::shown(std::filesystem::path(recording.csv_path).filename().string());
  file::RecordingMetadata metadata =
      file::headless_metadata(scene, outcome.ticks, {outcome.summary});
  metadata.realtime_status = "not in real time: the hand of " + name + ", re-run";
  std::erase_if(metadata.changes,
                [&](const ScheduledChange& change) { return change.tick >= outcome.ticks; });
  if (outcome.pointer_led) {
    metadata.repeatable = false;
    metadata.not_repeatable_because =
        "the pointer led the hand in " + name + "; `hapticwall replay` repeats it";
  }
  return metadata;
}

Result<Scene> recorded_scene(file::RecordingReader& recording, const file::LoadedScene& wanted) {
  const file::RecordingInfo& info = recording.info();
  const std::uint64_t end_tick = info.scanned.last_tick + 1;
  Scene scene = wanted.scene;
  scene.duration_s = static_cast<double>(end_tick) / scene.sampling.rate_hz;
  if (!scene.x().hand) return scene;
  Result<std::vector<double>> positions_m = recorded_path(recording);
  if (!positions_m) return positions_m.error();
  RecordedHand hand(scene, info.scanned.first_tick, std::move(*positions_m));
  SharedPath path;
  path.recorded = std::make_shared<const RecordedPieces>(RecordedPieces{
      scene.sampling.rate_hz, pieces_of(std::move(hand), hand_path(scene), end_tick)});
  path.file = std::filesystem::absolute(info.csv_path).string();
  path.sha256 = file::sha256_of(info.csv_path, info.scanned.end_offset).value_or("");
  scene.x().hand->path = std::move(path);
  scene.x().hand->follows_mouse = false;
  return scene;
}

Result<Overlay> rerun_as_overlay(file::RecordingReader& recording, const std::string& algorithm,
                                 const std::vector<std::string>& settings,
                                 const std::function<bool(double)>& keep_going) {
  const std::uint64_t rows = recording.rows();
  const std::string name = file::shown(recording.info().csv_path);
  if (rows > kMaxOverlaidTicks) {
    return Error{
        ErrorKind::kUsage,
        fmt::format("{}: an overlay shows at most {} ticks, this recording has {}; `hapticwall "
                    "replay --csv` records the re-run of any",
                    name, kMaxOverlaidTicks, rows)};
  }
  const auto scene = rerun_scene(recording.info(), algorithm, settings);
  if (!scene) return scene.error();
  Overlay overlay;
  overlay.label = algorithms()[scene->scene.algorithm.index].name;
  if (!settings.empty()) overlay.label += fmt::format(", {}", fmt::join(settings, ", "));
  overlay.samples.reserve(rows);
  RerunOptions options;
  options.on_sample = [&](const Sample& sample) { overlay.samples.push_back(sample); };
  options.keep_going = keep_going;
  const auto outcome = rerun_hand(recording, *scene, options);
  if (!outcome) return outcome.error();
  if (outcome->stopped_early) {
    return Error{ErrorKind::kUsage, name + ": the re-run was ended early"};
  }
  return overlay;
}

}  // namespace hapticwall::session
