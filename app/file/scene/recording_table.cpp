#include "app/file/recording_table.h"

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "app/file/scene_check.h"
#include "app/file/scene_tables.h"
#include "app/file/table_reader.h"

namespace hapticwall::file {
namespace {

// The hand of a change: all of it but the path, which stays that of the start.
HandSettings read_changed_hand(const toml::table& table, const std::string& name,
                               const HandSettings& first, const std::string& origin) {
  TableReader reader(table, name, origin);
  static_cast<void>(reader.table("y"));
  HandSettings hand;
  reader.numbers(hand_number_keys(), hand);
  reader.finish();
  hand.path = first.path;
  hand.follows_mouse = first.follows_mouse;
  return hand;
}

DeviceSettings read_changed_device(const TableReader& parent, const toml::table& table,
                                   const std::string& prefix, const std::string& name,
                                   const DeviceSettings& first, TableAxis axis) {
  DeviceSettings device = read_device(table, prefix + name + ".", parent.origin(), axis);
  if (device.start_m != first.start_m) {
    parent.fail(table, name + ".start_m", "a change leaves the start as it was");
  }
  return device;
}

// The second axis of a change, out of the tables of the first one.
void read_changed_second_axis(const TableReader& reader, const toml::table* device,
                              const toml::table* hand, const std::string& prefix, Scene& scene) {
  const toml::table* y_device = device != nullptr ? (*device)["y"].as_table() : nullptr;
  const toml::table* y_hand = hand != nullptr ? (*hand)["y"].as_table() : nullptr;
  for (const toml::table* table : {y_device, y_hand}) {
    if (table != nullptr && !scene.y) reader.fail(*table, "y", "the scene began with one axis");
  }
  if (y_device != nullptr) {
    scene.y->device =
        read_changed_device(reader, *y_device, prefix, "device.y", scene.y->device, TableAxis::kY);
  }
  if (y_hand != nullptr) {
    if (!scene.y->hand) reader.fail(*y_hand, "hand.y", "the scene began without it");
    scene.y->hand = read_changed_hand(*y_hand, prefix + "hand.y.", *scene.y->hand, reader.origin());
  }
}

// The plant of a change; a table that is not there is that of the start.
void read_changed_plant(TableReader& reader, const std::string& prefix, const std::string& origin,
                        Scene& scene) {
  const toml::table* device = reader.table("device");
  const toml::table* hand = reader.table("hand");
  if (device != nullptr && is_of_axis_x(*device)) {
    scene.device =
        read_changed_device(reader, *device, prefix, "device", scene.device, TableAxis::kX);
  }
  if (hand != nullptr && is_of_axis_x(*hand)) {
    if (!scene.hand) reader.fail(*hand, "hand", "the scene began without a hand");
    scene.hand = read_changed_hand(*hand, prefix + "hand.", *scene.hand, origin);
  }
  read_changed_second_axis(reader, device, hand, prefix, scene);
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
  static_cast<void>(reader.number("time_s", "s"));  // for people
  mark.text = reader.line("text", kLongestMarkBytes);
  reader.finish();
  return mark;
}

std::vector<Mark> read_marks(TableReader& parent) {
  std::vector<Mark> marks;
  for (const toml::table* table : parent.tables("mark")) {
    if (marks.size() == kMostMarks) {
      parent.fail(*table, "mark", fmt::format("more than {} of them", kMostMarks));
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
       {"program", "version", "build", "start_time", "device", "realtime", "csv_sha256"}) {
    static_cast<void>(reader.string(key));
  }
  for (const std::string_view key : {"rows", "dropped_rows"}) static_cast<void>(reader.count(key));
  for (const std::string_view key : {"complete", "recovered"}) {
    static_cast<void>(reader.boolean(key));
  }
  loaded.first_recorded_tick = reader.count("first_tick").value_or(0);
  const std::optional<std::string> reason = reader.string("not_repeatable_because");
  if (!reader.boolean("repeatable").value_or(true)) {
    loaded.not_repeatable_because = reason.value_or("the recording says so");
  }
  for (const toml::table* change : reader.tables("change")) {
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
