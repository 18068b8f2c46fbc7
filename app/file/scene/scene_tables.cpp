#include "app/file/scene/scene_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <filesystem>

#include "app/file/plugin/plugin_file.h"
#include "app/file/scene/hand_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"

namespace hapticwall::file {
namespace {

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

// A file of the scene is beside it, and one of --set in the current folder.
SharedPath read_file_path(const TableReader& reader, const toml::node& node,
                          const std::string& name) {
  const auto& source = node.source().path;
  const bool of_scene = source && *source == reader.origin();
  const auto folder = std::filesystem::path(of_scene ? reader.origin() : "").parent_path();
  Result<SharedPath> path = read_hand_file((folder / name).string());
  if (!path) reader.fail(node, "path_file", path.error().message);
  return std::move(*path);
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

void read_parameters(TableReader& reader, std::span<const ParameterDescription> parameters,
                     std::span<std::optional<double>> values) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    values[i] = read_parameter(reader, parameters[i]);
  }
}

}  // namespace

const toml::table* axis_table(const toml::table* table, std::size_t axis) {
  if (table == nullptr) return nullptr;
  if (axis > 0) return (*table)["y"].as_table();
  const bool holds_y_alone = table->size() == 1 && table->contains("y");
  return holds_y_alone ? nullptr : table;
}

DeviceSettings read_device(const toml::table& table, const std::string& prefix, std::size_t axis,
                           const std::string& origin) {
  TableReader reader(table, prefix + axis_key("device", axis) + ".", origin);
  if (axis == 0) static_cast<void>(reader.table("y"));  // has a call for itself
  DeviceSettings device;
  reader.numbers(device);
  reader.finish();
  return device;
}

HandSettings read_hand(const toml::table& table, std::size_t axis, const std::string& origin) {
  TableReader reader(table, axis_key("hand", axis) + ".", origin);
  if (axis == 0) static_cast<void>(reader.table("y"));
  HandSettings hand;
  reader.numbers(hand);
  const toml::node* path = reader.node("path");
  hand.follows_mouse = path != nullptr && path->value_or(std::string_view()) == "mouse";
  if (path != nullptr && !hand.follows_mouse) {
    hand.path = read_path(reader, *path, "path");
  }
  const std::optional<std::string> file = reader.string("path_file");
  // read_scene() compares it.
  if (reader.string("path_sha256") && !file) {
    reader.fail(*table.get("path_sha256"), "path_sha256", "there is no path_file");
  }
  if (file && path != nullptr) {
    reader.fail(*path, "path", "there is a path_file, too; the hand takes one of them");
  }
  if (file) hand.path = read_file_path(reader, *table.get("path_file"), *file);
  reader.finish();
  return hand;
}

void read_walls(TableReader& parent, const std::string& prefix, Scene& scene) {
  for (AxisSettings& axis : scene.axes) axis.walls.clear();
  const std::vector<const toml::table*> tables = parent.tables("wall");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const toml::table* table = tables[i];
    TableReader reader(*table, prefix + wall_key(i, tables.size()) + ".", parent.origin());
    WallSettings wall;
    reader.numbers(wall);
    const std::string axis = reader.string("axis").value_or("x");
    if (axis != "x" && axis != "y") {
      reader.fail(*table->get("axis"), "axis",
                  fmt::format("{} is no axis; it takes \"x\" or \"y\"", in_quotes(axis)));
    }
    if (axis == "y" && !scene.two_axes()) {
      reader.fail(*table->get("axis"), "axis",
                  "the scene has no second axis: add a table [device.y]");
    }
    reader.finish();
    scene.axes[axis == "y" ? 1 : 0].walls.push_back(wall);
  }
}

namespace {

// A scene loads no library: its plug-in must be in the list by the option of its kind, such as
// --algorithm. Returns if the name is none of a plug-in.
void refuse_plugin(TableReader& reader, const toml::node& node, const std::string& name,
                   const std::string& plugin, std::string_view kind) {
  if (!plugin.empty()) {
    reader.fail(node, "name",
                fmt::format("{} is of the plug-in {}, which a scene does not load; if you trust "
                            "it, --{} {} does",
                            in_quotes(name), in_quotes(plugin), kind, shown(plugin)));
  }
  if (names_plugin(name)) {
    reader.fail(node, "name",
                fmt::format("{} is a file, which a scene does not load; if you trust it, "
                            "--{} {} does",
                            in_quotes(name), kind, shown(name)));
  }
}

[[noreturn]] void refuse_name(TableReader& reader, const toml::node& node, const std::string& name,
                              std::string_view kind, const std::vector<std::string_view>& names) {
  reader.fail(node, "name",
              fmt::format("no {} is called {}{}; known: {}", kind, in_quotes(name),
                          suggestion(name, names), joined(names)));
}

}  // namespace

AlgorithmSettings read_algorithm(const toml::table& table, const std::string& prefix,
                                 const std::string& origin) {
  TableReader reader(table, prefix + "algorithm.", origin);
  AlgorithmSettings settings;
  const std::string plugin = reader.string("plugin_file").value_or("");
  static_cast<void>(reader.string("plugin_sha256"));  // read_scene() compares it
  if (const std::optional<std::string> name = reader.string("name")) {
    const std::optional<std::size_t> index = find_algorithm(*name);
    if (!index) {
      refuse_plugin(reader, *table.get("name"), *name, plugin, "algorithm");
      refuse_name(reader, *table.get("name"), *name, "algorithm",
                  names_of(algorithms(), &AlgorithmDescription::name));
    }
    settings.index = *index;
  }
  read_parameters(reader, algorithm_parameters(), settings.values);
  reader.finish();
  return settings;
}

EnvironmentSettings read_environment(const toml::table& table, const std::string& prefix,
                                     const std::string& origin) {
  TableReader reader(table, prefix + "environment.", origin);
  EnvironmentSettings settings;
  const std::string plugin = reader.string("plugin_file").value_or("");
  static_cast<void>(reader.string("plugin_sha256"));  // read_scene() compares it
  if (const std::optional<std::string> name = reader.string("name")) {
    const std::optional<std::size_t> index = find_environment(*name);
    const toml::node& node = *table.get("name");
    if (!index) {
      refuse_plugin(reader, node, *name, plugin, "environment");
      refuse_name(reader, node, *name, "environment", names_of(environments()));
    }
    settings.index = *index;
  }
  read_parameters(reader, environment_parameters(), settings.values);
  reader.finish();
  return settings;
}

EstimatorSettings read_estimator(const toml::table& table, const std::string& prefix,
                                 const std::string& origin) {
  TableReader reader(table, prefix + "estimator.", origin);
  EstimatorSettings settings;
  if (const std::optional<std::string> name = reader.string("name")) {
    const std::optional<std::size_t> index = find_estimator(*name);
    if (!index) refuse_name(reader, *table.get("name"), *name, "estimator", names_of(estimators()));
    settings.index = *index;
  }
  read_parameters(reader, estimator_parameters(), settings.values);
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
    // validate() reports a value that is out of range; here it must only fit into an int.
    simulator.substeps = static_cast<int>(std::min<std::uint64_t>(*substeps, INT_MAX));
  }
  reader.finish();
  return simulator;
}

}  // namespace hapticwall::file
