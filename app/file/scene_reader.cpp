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

DeviceSettings read_device(const toml::table& table, const std::string& prefix,
                           const std::string& origin) {
  TableReader reader(table, prefix + "device.", origin);
  for (const std::string_view key : {"x", "y"}) reader.refuse_unsupported(key);
  DeviceSettings device;
  reader.numbers(device_number_keys(), device);
  reader.finish();
  return device;
}

HandSettings read_hand(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "hand.", origin);
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

std::vector<WallSettings> read_walls(TableReader& parent, const std::string& prefix) {
  const std::vector<const toml::table*> tables = parent.tables("wall");
  std::vector<WallSettings> walls;
  for (const toml::table* table : tables) {
    const std::string name = tables.size() == 1 ? "wall." : fmt::format("wall[{}].", walls.size());
    TableReader reader(*table, prefix + name, parent.origin());
    WallSettings wall;
    reader.numbers(wall_number_keys(), wall);
    if (reader.string("axis").value_or("x") != "x") {
      reader.fail(*table->get("axis"), "axis", "only \"x\" is supported by this version");
    }
    reader.finish();
    walls.push_back(wall);
  }
  return walls;
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

void check(const Scene& scene, const toml::table& root, const std::string& prefix,
           const std::string& origin) {
  const std::optional<SceneProblem> problem = validate(scene);
  if (!problem) return;
  const std::string key = prefix + problem->key;
  throw ReadFailure(
      fmt::format("{}: {}: {}", place_of(node_at(root, key), origin), key, problem->message));
}

// The hand of a change: all of it but the path, which stays that of the start.
HandSettings read_changed_hand(const toml::table& table, const std::string& prefix,
                               const HandSettings& first, const std::string& origin) {
  TableReader reader(table, prefix + "hand.", origin);
  HandSettings hand;
  reader.numbers(hand_number_keys(), hand);
  reader.finish();
  hand.path = first.path;
  hand.follows_mouse = first.follows_mouse;
  return hand;
}

// The plant of a change; a table that is not there is that of the start.
void read_changed_plant(TableReader& reader, const std::string& prefix, const std::string& origin,
                        Scene& scene) {
  const Scene first = scene;
  if (const toml::table* device = reader.table("device")) {
    scene.device = read_device(*device, prefix, origin);
    if (scene.device.start_m != first.device.start_m) {
      reader.fail(*device, "device.start_m", "a change leaves the start as it was");
    }
  }
  if (const toml::table* hand = reader.table("hand")) {
    if (!first.hand) reader.fail(*hand, "hand", "the scene began without a hand");
    scene.hand = read_changed_hand(*hand, prefix, *first.hand, origin);
  }
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
  change.scene.walls = read_walls(reader, prefix);
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

Scene read_tables(TableReader& reader, const std::string& origin) {
  Scene scene;
  scene.name = reader.line("name", kLongestName);
  if (scene.name.empty()) scene.name = shown(std::filesystem::path(origin).stem().string());
  scene.description = reader.line("description", kLongestDescription);
  reader.numbers(scene_number_keys(), scene);
  if (const auto* table = reader.table("sampling")) scene.sampling = read_sampling(*table, origin);
  const toml::table absent_device;
  const toml::table* device = reader.table("device");
  scene.device = read_device(device == nullptr ? absent_device : *device, "", origin);
  if (const auto* table = reader.table("hand")) scene.hand = read_hand(*table, origin);
  scene.walls = read_walls(reader, "");
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
