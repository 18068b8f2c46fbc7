#include "app/file/scene/scene_reader.h"

#include <cstddef>
#include <filesystem>

#include "app/file/plugin/plugin_file.h"
#include "app/file/scene/scene_tables.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxSceneNameBytes = 100;
constexpr std::size_t kMaxSceneDescriptionBytes = 3000;  // including the text of a device file

void read_axes(TableReader& reader, const std::string& origin, Scene& scene) {
  const toml::table* devices = reader.table("device");
  if (devices == nullptr) reader.fail_missing("device", "a table [device]");
  const toml::table* hands = reader.table("hand");
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    const toml::table* device = i == 0 ? devices : axis_table(devices, i);
    const toml::table* hand = axis_table(hands, i);
    if (device == nullptr && hand != nullptr) {
      reader.fail(*hand, "hand.y", "the scene has no second axis: add a table [device.y]");
    }
    if (device == nullptr) return;
    scene.axes.resize(i + 1);
    scene.axes[i].device = read_device(*device, "", i, origin);
    if (hand != nullptr) scene.axes[i].hand = read_hand(*hand, i, origin);
  }
}

Scene read_tables(TableReader& reader, const std::string& origin) {
  Scene scene;
  scene.name = reader.line("name", kMaxSceneNameBytes);
  if (scene.name.empty()) scene.name = shown(std::filesystem::path(origin).stem().string());
  scene.description = reader.line("description", kMaxSceneDescriptionBytes);
  reader.numbers(scene);
  if (const auto* table = reader.table("sampling")) {
    TableReader sampling(*table, "sampling.", origin);
    sampling.numbers(scene.sampling);
    sampling.finish();
  }
  read_axes(reader, origin, scene);
  read_walls(reader, "", scene);
  if (const auto* table = reader.table("environment")) {
    scene.environment = read_environment(*table, "", origin);
  }
  if (const auto* table = reader.table("algorithm")) {
    scene.algorithm = read_algorithm(*table, "", origin);
  }
  if (const auto* table = reader.table("estimator")) {
    scene.estimator = read_estimator(*table, "", origin);
  }
  if (const auto* table = reader.table("simulator")) {
    scene.simulator = read_simulator(*table, "", origin);
  }
  return scene;
}

// Checks the table of a map; its values are for people.
void check_map(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "map.", origin);
  for (const std::string_view key :
       {"program", "version", "build", "x", "y", "algorithms", "plugins"}) {
    static_cast<void>(reader.string(key));
  }
  for (const std::string_view key : {"first_cell", "cells"}) static_cast<void>(reader.count(key));
  reader.finish();
}

// The hand's file that has other bytes than the scene says, or "".
std::string changed_hand_file(const toml::table& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const toml::table* hand = axis_table(root["hand"].as_table(), i);
    if (hand == nullptr || !hand->contains("path_sha256")) continue;
    const SharedPath& path = scene.axes[i].hand->path;
    if ((*hand)["path_sha256"].value_or(std::string_view()) != path.sha256) return path.file;
  }
  return "";
}

// The plug-in's file that has other bytes than the table says, or "". Another algorithm or
// environment may have taken the plug-in's place: `plugin` is then nullptr.
std::string changed_file(toml::node_view<const toml::node> table, const PluginFile* plugin) {
  const auto recorded = table["plugin_sha256"].value<std::string_view>();
  return plugin != nullptr && recorded && *recorded != plugin->sha256 ? plugin->path : "";
}

// `tables`: a scene, or a change of a recording.
std::string changed_plugin(const toml::table& tables, const Scene& scene) {
  std::string path = changed_file(tables["algorithm"], plugin_file(scene.algorithm.index));
  if (!path.empty()) return path;
  return changed_file(tables["environment"], environment_file(scene.environment.index));
}

// Path of a changed plug-in of the scene or of one of its changes.
std::string changed_plugin(const toml::table& root, const LoadedScene& loaded) {
  std::string path = changed_plugin(root, loaded.scene);
  for (std::size_t i = 0; path.empty() && i < loaded.changes.size(); ++i)
    path = changed_plugin(*root["recording"]["change"][i].as_table(), loaded.changes[i].scene);
  return path;
}

}  // namespace

LoadedScene read_scene(const toml::table& root, const std::string& origin) {
  TableReader reader(root, "", origin);
  LoadedScene loaded;
  loaded.scene = read_tables(reader, origin);
  const toml::table* recording = reader.table("recording");
  if (const toml::table* map = reader.table("map")) check_map(*map, origin);
  reader.finish();
  check(loaded.scene, root, "", origin);
  if (recording != nullptr) read_recording(*recording, root, origin, loaded);
  loaded.changed_plugin = changed_plugin(root, loaded);
  std::string file = changed_hand_file(root, loaded.scene);
  if (file.empty()) file = loaded.changed_plugin;
  if (!file.empty()) {
    loaded.not_repeatable_because = shown(file) + " was changed since (SHA-256 differs)";
  }
  return loaded;
}

}  // namespace hapticwall::file
