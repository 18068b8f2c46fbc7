#include "app/file/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <filesystem>
#include <utility>

#include "app/file/table_reader.h"
#include "app/file/text.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kLongestName = 100;
constexpr std::size_t kLongestDescription = 1000;

std::vector<PathPoint> read_path(const TableReader& reader, const toml::node& node,
                                 std::string_view key) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    reader.fail(node, key, "neither [[time s, position m], ...] nor \"mouse\"");
  }
  std::vector<PathPoint> points;
  for (const toml::node& element : *array) {
    const std::optional<PathPoint> point = path_point(element);
    if (!point) {
      reader.fail(element, key, fmt::format("point {} is not [time s, position m]", points.size()));
    }
    points.push_back(*point);
  }
  return points;
}

SamplingSettings read_sampling(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "sampling.", origin);
  SamplingSettings sampling;
  reader.numbers(sampling_number_keys(), sampling);
  reader.finish();
  return sampling;
}

// A table of axis x holds that of axis y; this is whether it holds anything of its own.
bool is_of_axis_x(const toml::table& table) {
  return table.empty() || table.size() > 1 || !table.contains("y");
}

enum class TableAxis : std::uint8_t { kX, kY };

// `name`: "device." or "device.y.", with what stands before it.
DeviceSettings read_device(const toml::table& table, const std::string& name,
                           const std::string& origin, TableAxis axis) {
  TableReader reader(table, name, origin);
  if (axis == TableAxis::kX) static_cast<void>(reader.table("y"));  // read by itself
  DeviceSettings device;
  reader.numbers(device_number_keys(), device);
  reader.finish();
  return device;
}

HandSettings read_hand(const toml::table& table, const std::string& name, const std::string& origin,
                       TableAxis axis) {
  TableReader reader(table, name, origin);
  if (axis == TableAxis::kX) static_cast<void>(reader.table("y"));
  HandSettings hand;
  reader.numbers(hand_number_keys(), hand);
  const toml::node* path = reader.node("path");
  hand.follows_mouse = path != nullptr && path->value_or(std::string_view()) == "mouse";
  if (path != nullptr && !hand.follows_mouse) {
    hand.path = read_path(reader, *path, "path");
  }
  reader.finish();
  return hand;
}

// All walls of the scene, or of a change of it.
void read_walls(TableReader& parent, const std::string& prefix, Scene& scene) {
  scene.walls.clear();
  if (scene.y) scene.y->walls.clear();
  const std::vector<const toml::table*> tables = parent.tables("wall");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const toml::table* table = tables[i];
    const std::string name = tables.size() == 1 ? "wall." : fmt::format("wall[{}].", i);
    TableReader reader(*table, prefix + name, parent.origin());
    WallSettings wall;
    reader.numbers(wall_number_keys(), wall);
    const std::string axis = reader.string("axis").value_or("x");
    if (axis != "x" && axis != "y") {
      reader.fail(*table->get("axis"), "axis",
                  fmt::format("{} is no axis; it takes \"x\" or \"y\"", in_quotes(axis)));
    }
    if (axis == "y" && !scene.y) {
      reader.fail(*table->get("axis"), "axis",
                  "the scene has no second axis: it takes a table [device.y]");
    }
    reader.finish();
    (axis == "y" ? scene.y->walls : scene.walls).push_back(wall);
  }
}

std::vector<std::string_view> algorithm_names() {
  std::vector<std::string_view> names;
  for (const AlgorithmDescription& algorithm : algorithms()) names.push_back(algorithm.name);
  return names;
}

double read_choice(TableReader& reader, const ParameterDescription& parameter,
                   const toml::node& node) {
  const std::string word = *reader.string(parameter.key);
  for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
    if (parameter.choices[i] == word) return static_cast<double>(i);
  }
  reader.fail(node, parameter.key,
              fmt::format("{} is none of: {}", in_quotes(word), joined(parameter.choices)));
}

std::optional<double> read_parameter(TableReader& reader, const ParameterDescription& parameter) {
  const toml::node* node = reader.node(parameter.key);
  if (node == nullptr) return std::nullopt;
  if (parameter.kind == ParameterKind::kNumber) return reader.number(parameter.key, parameter.unit);
  if (parameter.kind == ParameterKind::kChoice) return read_choice(reader, parameter, *node);
  return *reader.boolean(parameter.key) ? 1.0 : 0.0;
}

AlgorithmSettings read_algorithm(const toml::table& table, const std::string& prefix,
                                 const std::string& origin) {
  TableReader reader(table, prefix + "algorithm.", origin);
  AlgorithmSettings settings;
  if (const std::optional<std::string> name = reader.string("name")) {
    const std::optional<std::size_t> index = find_algorithm(*name);
    if (!index) {
      const std::vector<std::string_view> names = algorithm_names();
      reader.fail(*table.get("name"), "name",
                  fmt::format("no algorithm is called {}{}; known: {}", in_quotes(*name),
                              suggestion(*name, names), joined(names)));
    }
    settings.index = *index;
  }
  const std::span<const ParameterDescription> parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    settings.values.at(i) = read_parameter(reader, parameters[i]);
  }
  reader.finish();
  return settings;
}

SimulatorSettings read_simulator(const toml::table& table, const std::string& prefix,
                                 const std::string& origin) {
  TableReader reader(table, prefix + "simulator.", origin);
  SimulatorSettings simulator;
  if (const std::optional<std::string> name = reader.string("integrator")) {
    const std::optional<Integrator> integrator = find_integrator(*name);
    if (!integrator) {
      const std::vector<std::string_view> names(kIntegratorNames.begin(), kIntegratorNames.end());
      reader.fail(*table.get("integrator"), "integrator",
                  fmt::format("no integrator is called {}{}; known: {}", in_quotes(*name),
                              suggestion(*name, names), joined(names)));
    }
    simulator.integrator = *integrator;
  }
  if (const std::optional<std::uint64_t> substeps = reader.count("substeps")) {
    // Out of range is for validate() to say; it must only survive the way there.
    simulator.substeps = static_cast<int>(std::min<std::uint64_t>(*substeps, INT_MAX));
  }
  reader.finish();
  return simulator;
}

// The node that a problem's key names, or the nearest that encloses it.
const toml::node& node_at(const toml::table& root, std::string key) {
  while (!key.empty()) {
    const auto found = toml::at_path(root, key);
    if (found) return *found.node();
    constexpr std::string_view kOnlyWall = "wall.";
    const std::size_t wall = key.rfind(kOnlyWall);
    if (wall != std::string::npos) {
      std::string indexed = key;
      const auto inner = toml::at_path(root, indexed.replace(wall, kOnlyWall.size(), "wall[0]."));
      if (inner) return *inner.node();
    }
    key.resize(key.find_last_of(".[") == std::string::npos ? 0 : key.find_last_of(".["));
  }
  return root;
}

// validate() counts the walls of axis x first; a file may have them in any order.
std::string in_order_of_file(const std::string& key, const toml::table& root,
                             const std::string& prefix) {
  constexpr std::string_view kWall = "wall[";
  const toml::array* walls = toml::at_path(root, prefix + "wall").as_array();
  if (!key.starts_with(kWall) || walls == nullptr) return key;
  const std::size_t end = key.find(']');
  const auto counted = static_cast<std::size_t>(std::stoul(key.substr(kWall.size())));
  std::vector<std::size_t> order;
  for (const bool second : {false, true}) {
    for (std::size_t i = 0; i < walls->size(); ++i) {
      const toml::table* wall = walls->get(i)->as_table();
      if (wall != nullptr && ((*wall)["axis"].value_or(std::string_view("x")) == "y") == second) {
        order.push_back(i);
      }
    }
  }
  return counted < order.size() ? fmt::format("wall[{}{}", order[counted], key.substr(end)) : key;
}

void check(const Scene& scene, const toml::table& root, const std::string& prefix,
           const std::string& origin) {
  const std::optional<SceneProblem> problem = validate(scene);
  if (!problem) return;
  const std::string key = prefix + in_order_of_file(problem->key, root, prefix);
  throw ReadFailure(
      fmt::format("{}: {}: {}", place_of(node_at(root, key), origin), key, problem->message));
}

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

void read_recording(const toml::table& table, const toml::table& root, const std::string& origin,
                    LoadedScene& loaded) {
  TableReader reader(table, "recording.", origin);
  for (const std::string_view key :
       {"program", "version", "build", "start_time", "device", "realtime", "csv_sha256"}) {
    static_cast<void>(reader.string(key));
  }
  for (const std::string_view key : {"rows", "dropped_rows"}) static_cast<void>(reader.count(key));
  static_cast<void>(reader.boolean("complete"));
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

// Out of the tables of the first axis.
void read_second_axis(const TableReader& reader, const toml::table& device, const toml::table* hand,
                      Scene& scene) {
  const toml::table* y_hand = hand != nullptr ? (*hand)["y"].as_table() : nullptr;
  const toml::table* y_device = device["y"].as_table();
  if (y_device != nullptr) {
    scene.y.emplace();
    scene.y->device = read_device(*y_device, "device.y.", reader.origin(), TableAxis::kY);
  }
  if (y_hand == nullptr) return;
  if (!scene.y) {
    reader.fail(*y_hand, "hand.y", "the scene has no second axis: it takes a table [device.y]");
  }
  scene.y->hand = read_hand(*y_hand, "hand.y.", reader.origin(), TableAxis::kY);
}

Scene read_tables(TableReader& reader, const std::string& origin) {
  Scene scene;
  scene.name = reader.line("name", kLongestName);
  if (scene.name.empty()) scene.name = shown(std::filesystem::path(origin).stem().string());
  scene.description = reader.line("description", kLongestDescription);
  reader.numbers(scene_number_keys(), scene);
  if (const auto* table = reader.table("sampling")) scene.sampling = read_sampling(*table, origin);
  const toml::table absent_device;
  const toml::table* device = reader.table("device");
  if (device == nullptr) device = &absent_device;
  scene.device = read_device(*device, "device.", origin, TableAxis::kX);
  const toml::table* hand = reader.table("hand");
  if (hand != nullptr && is_of_axis_x(*hand)) {
    scene.hand = read_hand(*hand, "hand.", origin, TableAxis::kX);
  }
  read_second_axis(reader, *device, hand, scene);
  read_walls(reader, "", scene);
  if (const auto* table = reader.table("algorithm")) {
    scene.algorithm = read_algorithm(*table, "", origin);
  }
  if (const auto* table = reader.table("simulator")) {
    scene.simulator = read_simulator(*table, "", origin);
  }
  return scene;
}

}  // namespace

LoadedScene read_scene(const toml::table& root, const std::string& origin) {
  TableReader reader(root, "", origin);
  LoadedScene loaded;
  loaded.scene = read_tables(reader, origin);
  const toml::table* recording = reader.table("recording");
  reader.finish();
  check(loaded.scene, root, "", origin);
  if (recording != nullptr) read_recording(*recording, root, origin, loaded);
  return loaded;
}

}  // namespace hapticwall::file
