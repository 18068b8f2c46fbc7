// Reads the table [recording] of a sidecar: changes, marks and how to repeat the session.
#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "app/file/scene/scene_reader.h"
#include "app/file/scene/scene_tables.h"
#include "app/file/scene/table_reader.h"

namespace hapticwall::file {
namespace {

// The hand of a change, with the path of the start.
HandSettings read_changed_hand(const toml::table& table, const std::string& name,
                               const HandSettings& first, const std::string& origin) {
  TableReader reader(table, name, origin);
  static_cast<void>(reader.table("y"));
  HandSettings hand;
  reader.numbers(hand);
  reader.finish();
  hand.path = first.path;
  hand.follows_mouse = first.follows_mouse;
  return hand;
}

DeviceSettings read_changed_device(const TableReader& parent, const toml::table& table,
                                   const std::string& prefix, std::size_t axis,
                                   const DeviceSettings& first) {
  DeviceSettings device = read_device(table, prefix, axis, parent.origin());
  if (device.start_m != first.start_m) {
    parent.fail(table, axis_key("device", axis) + ".start_m",
                "a change leaves the start as it was");
  }
  return device;
}

void read_changed_axes(const TableReader& reader, const toml::table* device,
                       const toml::table* hand, const std::string& prefix, Scene& scene) {
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    const toml::table* of_device = axis_table(device, i);
    const toml::table* of_hand = axis_table(hand, i);
    if (of_device == nullptr && of_hand == nullptr) continue;
    if (i == scene.axes.size()) {
      reader.fail(of_device != nullptr ? *of_device : *of_hand, "y",
                  "the scene began with one axis");
    }
    AxisSettings& axis = scene.axes[i];
    if (of_device != nullptr) {
      axis.device = read_changed_device(reader, *of_device, prefix, i, axis.device);
    }
    if (of_hand == nullptr) continue;
    const std::string key = axis_key("hand", i);
    if (!axis.hand) reader.fail(*of_hand, key, "the scene began without this hand");
    axis.hand = read_changed_hand(*of_hand, prefix + key + ".", *axis.hand, reader.origin());
  }
}

SamplingSettings read_changed_sampling(const TableReader& parent, const toml::table& table,
                                       const std::string& prefix, const SamplingSettings& first) {
  TableReader reader(table, prefix + "sampling.", parent.origin());
  SamplingSettings sampling;
  reader.numbers(sampling);
  reader.finish();
  if (!sampling.same_clock(first))
    parent.fail(table, "sampling", "a change leaves rate, jitter and seed as they were");
  return sampling;
}

// The plant of a change. A table that is absent keeps the settings of the start.
void read_changed_plant(TableReader& reader, const std::string& prefix, const std::string& origin,
                        Scene& scene) {
  read_changed_axes(reader, reader.table("device"), reader.table("hand"), prefix, scene);
  if (const toml::table* sampling = reader.table("sampling"))
    scene.sampling = read_changed_sampling(reader, *sampling, prefix, scene.sampling);
  if (const toml::table* simulator = reader.table("simulator")) {
    scene.simulator = read_simulator(*simulator, prefix, origin);
  }
}

ScheduledChange read_change(const toml::table& table, const std::string& prefix, const Scene& first,
                            const std::string& origin) {
  TableReader reader(table, prefix, origin);
  ScheduledChange change{reader.count("tick").value_or(0), first};
  if (reader.node("tick") == nullptr) reader.fail_missing("tick", "a whole number");
  if (const toml::table* algorithm = reader.table("algorithm")) {
    change.scene.algorithm = read_algorithm(*algorithm, prefix, origin);
  }
  if (const toml::table* environment = reader.table("environment")) {
    change.scene.environment = read_environment(*environment, prefix, origin);
  }
  if (const toml::table* estimator = reader.table("estimator")) {
    change.scene.estimator = read_estimator(*estimator, prefix, origin);
  }
  read_changed_plant(reader, prefix, origin, change.scene);
  read_walls(reader, prefix, change.scene);
  reader.finish();
  return change;
}

Mark read_mark(const toml::table& table, std::size_t index, const std::string& origin) {
  TableReader reader(table, fmt::format("recording.mark[{}].", index), origin);
  Mark mark;
  mark.tick = reader.count("tick").value_or(0);
  if (reader.node("tick") == nullptr) reader.fail_missing("tick", "a whole number");
  static_cast<void>(reader.number("time_s", "s"));  // for people only
  mark.text = reader.line("text", kMaxMarkBytes);
  reader.finish();
  return mark;
}

std::vector<Mark> read_marks(TableReader& parent) {
  std::vector<Mark> marks;
  for (const toml::table* table : parent.tables("mark")) {
    if (marks.size() == kMaxMarks) {
      parent.fail(*table, "mark", fmt::format("more than {} of them", kMaxMarks));
    }
    Mark mark = read_mark(*table, marks.size(), parent.origin());
    if (!marks.empty() && mark.tick < marks.back().tick) {
      parent.fail(*table, "mark", "the ticks of the marks are not in order");
    }
    marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace

void read_recording(const toml::table& table, const toml::table& root, const std::string& origin,
                    LoadedScene& loaded) {
  TableReader reader(table, "recording.", origin);
  for (const std::string_view key :
       {"program", "version", "build", "start_time", "device", "realtime", "sidecar_sha256"}) {
    static_cast<void>(reader.string(key));
  }
  for (const std::string_view key : {"rows", "dropped_rows"}) static_cast<void>(reader.count(key));
  for (const std::string_view key : {"complete", "recovered"}) {
    static_cast<void>(reader.boolean(key));
  }
  loaded.csv_sha256 = reader.string("csv_sha256").value_or("");
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    loaded.diverged_at_tick.at(axis) = reader.count(kDivergedKeys.at(axis));
  }
  loaded.first_recorded_tick = reader.count("first_tick").value_or(0);
  const std::optional<std::string> reason = reader.string("not_repeatable_because");
  if (!reader.boolean("repeatable").value_or(true)) {
    loaded.not_repeatable_because = reason.value_or("the recording says so");
  }
  for (const toml::table* change : reader.tables("change")) {
    if (loaded.changes.size() == kMaxChanges) reader.fail(*change, "change", kTooManyChanges);
    const std::string prefix = fmt::format("recording.change[{}].", loaded.changes.size());
    ScheduledChange read = read_change(*change, prefix, loaded.scene, origin);
    if (!loaded.changes.empty() && read.tick < loaded.changes.back().tick) {
      reader.fail(*change, "change", "the ticks of the changes are not in order");
    }
    check(read.scene, root, prefix, origin);
    loaded.changes.push_back(std::move(read));
  }
  loaded.marks = read_marks(reader);
  reader.finish();
}

}  // namespace hapticwall::file
