#include "app/file/recording/recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/recording/recording_reader.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/hand_file.h"
#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/plant/plant_model.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kRowsAtATime = 1024;

// Checks row by row whether the hand of one axis follows its script.
class ScriptedHand {
 public:
  explicit ScriptedHand(const Scene& scene) : has_hand_(scene.x().hand), path_(hand_path(scene)) {}

  // True if the hand is on its scripted path. Call it with the rows in order; rows may be missing.
  [[nodiscard]] bool is_where_it_should_be(const Sample& sample) {
    go_to(sample.tick);
    return !has_hand_ || path_.position_m() == sample.truth.hand_path_m;
  }

 private:
  // One step for each straight piece: a file may begin at any tick.
  void go_to(std::uint64_t tick) {
    while (path_.straight().tick < tick) {
      StraightPath straight = path_.straight();
      if (!straight.goes_on()) {
        path_.next_tick();
        continue;
      }
      straight.tick = std::min(tick, straight.straight_until_tick - 1) - 1;
      straight.next_tick();
      path_.resume(straight);
    }
  }

  bool has_hand_;
  HandPath path_;
};

// Events in the rows that NAME.toml.partial may lack.
class UnknownEvents {
 public:
  explicit UnknownEvents(const RecordingInfo& info) : info_(info) {
    if (!info.of_simulator()) return;
    const Scene& scene = info.loaded.scene;
    for (std::size_t i = 0; i < scene.axes.size(); ++i) hands_.emplace_back(axis_scene(scene, i));
  }

  void look_at(const Tick& row) {
    const Sample& x = row.x();
    const bool changed = (x.flags & kFlagParametersChanged) != 0;
    if (changed && !is_known(x.tick) && !unknown_change_) unknown_change_ = x.tick;
    for (std::size_t axis = 0; axis < hands_.size() && !led_; ++axis) {
      led_ = !hands_[axis].is_where_it_should_be(row.axes[axis]);
    }
  }

  // The reason why the session cannot be repeated; empty if it can.
  [[nodiscard]] std::string reason() const {
    if (unknown_change_) {
      return fmt::format(
          "parameters changed at tick {}, just before the session was cut off; the new values are "
          "unknown",
          *unknown_change_);
    }
    return led_ ? "the hand was not where its path leads: something else led it" : "";
  }

 private:
  [[nodiscard]] bool is_known(std::uint64_t tick) const {
    return std::ranges::any_of(info_.loaded.changes,
                               [&](const ScheduledChange& change) { return change.tick == tick; });
  }

  const RecordingInfo& info_;
  std::vector<ScriptedHand> hands_;
  std::optional<std::uint64_t> unknown_change_;
  bool led_ = false;
};

Result<std::string> find_unknown_events(RecordingReader& reader) {
  UnknownEvents events(reader.info());
  std::vector<Tick> rows(kRowsAtATime);
  for (std::uint64_t row = 0; row < reader.rows();) {
    const Result<std::size_t> count = reader.read(row, rows);
    if (!count) return count.error();
    for (const Tick& tick : std::span(rows).first(*count)) events.look_at(tick);
    row += *count;
  }
  return events.reason();
}

RecordingMetadata metadata_of(const RecordingInfo& info, const std::string& unknown_event) {
  const std::uint64_t end_tick = info.scanned.last_tick + 1;
  RecordingMetadata metadata;
  metadata.start_time = info.start_time;
  metadata.device = info.device;
  metadata.realtime_status = info.realtime;
  metadata.first_tick = info.scanned.first_tick;
  metadata.dropped_rows = info.scanned.missing_rows;
  metadata.recovered = true;
  metadata.not_repeatable_because = info.loaded.not_repeatable_because;
  if (metadata.not_repeatable_because.empty()) metadata.not_repeatable_because = unknown_event;
  metadata.repeatable = metadata.not_repeatable_because.empty();
  for (const ScheduledChange& change : info.loaded.changes) {
    if (change.tick < end_tick) metadata.changes.push_back(change);
  }
  for (Mark mark : info.loaded.marks) {
    mark.tick = std::clamp(mark.tick, info.scanned.first_tick, info.scanned.last_tick);
    metadata.marks.push_back(std::move(mark));
  }
  return metadata;
}

// The final name of a recording, from its final or its partial name.
std::string csv_path_of(std::string path) {
  if (path.ends_with(kPartialEnding)) path.resize(path.size() - kPartialEnding.size());
  return path;
}

Failure check_names(const std::string& csv_path, const std::string& partial) {
  std::error_code ignored;
  if (!std::filesystem::exists(partial, ignored)) {
    const bool whole = std::filesystem::is_regular_file(csv_path, ignored);
    return usage_error(fmt::format("{}: there is no such file{}", shown(partial),
                                   whole ? "; the recording is whole already" : ""));
  }
  if (std::filesystem::exists(csv_path, ignored)) {
    return usage_error(
        fmt::format("{} is there already: move it away, or rename {} and its sidecar",
                    shown(csv_path), shown(partial)));
  }
  const std::string sidecar = sidecar_path_of(partial);
  if (!std::filesystem::exists(sidecar, ignored) && !lacks_only_its_name(csv_path)) {
    return usage_error(
        fmt::format("{}: the file is missing, so the scene is unknown; "
                    "'hapticwall replay {}' shows the rows",
                    shown(sidecar), shown(partial)));
  }
  const std::string obstacle = sidecar_obstacle(sidecar_path_of(csv_path), kRecordingTable);
  if (!obstacle.empty()) {
    return usage_error(fmt::format("{} is {} and would be replaced: move it away",
                                   shown(sidecar_path_of(csv_path)), obstacle));
  }
  return {};
}

// The CSV's SHA-256 in a finished sidecar; empty if there is none.
std::string claimed_sha256(const std::string& sidecar_path) {
  const Result<std::string> text = read_small_file(sidecar_path, "sidecar", kMaxSidecarBytes);
  const Result<LoadedScene> loaded = text ? parse_scene(*text, sidecar_path) : text.error();
  return loaded ? loaded->csv_sha256 : "";
}

// Cuts off an incomplete last row and gives the CSV its name.
Result<Recovered> finish_names(AtomicFile csv, const RecordingInfo& info) {
  Recovered recovered{csv.path(),
                      info.scanned.rows,
                      info.scanned.missing_rows,
                      csv.size() - info.scanned.end_offset,
                      {}};
  if (Failure failed = csv.keep_only(info.scanned.end_offset)) return *failed;
  if (Failure failed = csv.commit()) return *failed;
  return recovered;
}

}  // namespace

bool lacks_only_its_name(const std::string& csv_path) {
  const std::string partial = partial_of(csv_path);
  const std::string claimed = claimed_sha256(sidecar_path_of(csv_path));
  if (claimed.empty()) return false;
  const auto reader = RecordingReader::open(partial);
  if (!reader) return false;
  return sha256_of(partial, (*reader)->info().scanned.end_offset) == claimed;
}

Result<Recovered> recover_recording(const std::string& path) {
  const Result<OutputPlace> place = output_place(csv_path_of(path));
  if (!place) return place.error();
  const std::string& csv_path = place->path;
  const std::string partial = partial_of(csv_path);
  if (Failure failed = check_names(csv_path, partial)) return *failed;
  Result<AtomicFile> csv = AtomicFile::resume(csv_path);  // locks it: no other process writes it
  if (!csv) return csv.error();
  csv->keep_partial();
  const auto reader = RecordingReader::open(partial);
  if (!reader) return reader.error();
  const RecordingInfo& info = (*reader)->info();
  std::error_code ignored;
  if (!std::filesystem::exists(sidecar_path_of(partial), ignored)) {
    return finish_names(std::move(*csv), info);
  }
  if (!info.has_sidecar) return usage_error(info.sidecar_problem);
  const Result<std::string> unknown_event = find_unknown_events(**reader);
  if (!unknown_event) return unknown_event.error();
  // Read anew: a user may have edited the rows.
  const auto csv_sha256 = sha256_of(partial, info.scanned.end_offset);
  if (!csv_sha256) return usage_error(shown(partial) + ": changed while it was read");

  const RecordingMetadata metadata = metadata_of(info, *unknown_event);
  const RecordedRows counted{info.scanned.rows, metadata.dropped_rows, info.scanned.last_tick + 1,
                             *csv_sha256};
  const std::string text = sidecar_toml(beside(info.loaded.scene, csv_path), metadata, counted);
  if (Failure failed = write_sidecar(csv_path, text)) return *failed;
  Result<Recovered> recovered = finish_names(std::move(*csv), info);
  if (recovered && info.loaded.edited) recovered->notes.emplace_back(kEditedSidecar);
  if (recovered && !metadata.repeatable) {
    recovered->notes.push_back("'run' will not repeat it: " + metadata.not_repeatable_because);
  }
  return recovered;
}

}  // namespace hapticwall::file
