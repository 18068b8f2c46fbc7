#include "app/file/scene_reader.h"

#include <cstddef>
#include <filesystem>

#include "app/file/recording_table.h"
#include "app/file/scene_check.h"
#include "app/file/scene_tables.h"
#include "app/file/table_reader.h"
#include "app/file/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kLongestSceneName = 100;
constexpr std::size_t kLongestSceneDescription = 1000;

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
  scene.name = reader.line("name", kLongestSceneName);
  if (scene.name.empty()) scene.name = shown(std::filesystem::path(origin).stem().string());
  scene.description = reader.line("description", kLongestSceneDescription);
  reader.numbers(scene_number_keys(), scene);
  if (const auto* table = reader.table("sampling")) scene.sampling = read_sampling(*table, origin);
  const toml::table* device = reader.table("device");
  if (device == nullptr) reader.fail_missing("device", "a table [device]");
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

// What was made of the scene; for people.
void check_map(const toml::table& table, const std::string& origin) {
  TableReader reader(table, "map.", origin);
  for (const std::string_view key : {"program", "version", "build", "x", "y", "algorithms"}) {
    static_cast<void>(reader.string(key));
  }
  for (const std::string_view key : {"first_cell", "cells"}) static_cast<void>(reader.count(key));
  reader.finish();
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
  return loaded;
}

}  // namespace hapticwall::file
