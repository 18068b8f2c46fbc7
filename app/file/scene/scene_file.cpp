#include "app/file/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "app/file/disk/small_file.h"
#include "app/file/scene/scene_reader.h"
#include "app/file/scene/seal.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"
#include "embedded_scenes.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxSceneBytes = std::size_t{1} << 20U;

Result<LoadedScene> load_file(const std::string& path, std::span<const std::string> overrides) {
  const std::size_t largest_bytes =
      is_sidecar(path, kRecordingTable) ? kMaxSidecarBytes : kMaxSceneBytes;
  const Result<std::string> text = read_small_file(path, "scene", largest_bytes);
  if (!text) return text.error();
  return parse_scene(*text, path, overrides);
}

toml::table table_or_empty(const toml::table& root, std::string_view key) {
  const toml::table* table = root[key].as_table();
  return table != nullptr ? *table : toml::table();
}

// Puts numbers in the place of the names of a device and of hands; `device` and `hand` are the
// tables before. Adds the files to `files`.
void resolve_names(toml::table& root, const toml::table& device, const toml::table& hand,
                   const std::string& origin, std::vector<std::string>& files) {
  files.push_back(resolve_device(root, device, origin));
  for (std::string& file : resolve_hands(root, hand, origin)) files.push_back(std::move(file));
}

std::vector<BuiltinScene> read_builtin_scenes() {
  std::vector<BuiltinScene> scenes;
  for (const EmbeddedFile& embedded : embedded_scenes()) {
    const std::string name = std::filesystem::path(embedded.name).stem().string();
    const Result<LoadedScene> loaded = parse_scene(embedded.bytes, std::string(embedded.name));
    scenes.push_back(
        {name, loaded ? loaded->scene.description : loaded.error().message, embedded.bytes});
  }
  // The golden scenes come last: they are for checking the program.
  const auto rank = [](const BuiltinScene& scene) {
    return std::pair(scene.name.starts_with("golden-"), std::string_view(scene.name));
  };
  std::sort(scenes.begin(), scenes.end(),
            [&](const BuiltinScene& a, const BuiltinScene& b) { return rank(a) < rank(b); });
  return scenes;
}

}  // namespace

Result<Scene> with_device(Scene scene, const std::string& name) {
  Scene alone;
  alone.sampling = scene.sampling;
  alone.x().device = scene.x().device;
  try {
    toml::table root = parse_toml(scene_to_toml(alone), "");
    const toml::table before = *root["device"].as_table();
    root.insert_or_assign("device", name);
    resolve_device(root, before, name);
    scene.x().device = read_scene(root, name).scene.x().device;
    return scene;
  } catch (const ReadFailure& failure) {
    return usage_error(failure.what());
  }
}

// shown() may exceed its limit by 3 bytes of a last character and by three dots.
std::string mark_text(std::string_view typed) {
  constexpr std::size_t kEndBytes = 3 + 3;
  return shown(typed, kMaxMarkBytes - kEndBytes);
}

bool is_sidecar(const std::string& path, std::string_view table) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return false;
  if (std::filesystem::file_size(path, failed) > kMaxSidecarBytes || failed) return false;
  const std::string first_line = fmt::format("[{}]", table);
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line == first_line) return true;
  }
  return false;
}

Result<LoadedScene> parse_scene(std::string_view toml_text, const std::string& origin,
                                std::span<const std::string> overrides) {
  try {
    toml::table root = parse_toml(toml_text, origin);
    std::vector<std::string> files;
    resolve_names(root, {}, {}, origin, files);
    for (const std::string& text : overrides) {
      const toml::table device = table_or_empty(root, "device");
      const toml::table hand = table_or_empty(root, "hand");
      apply_override(root, text);
      resolve_names(root, device, hand, origin, files);
    }
    LoadedScene loaded = read_scene(root, origin);
    loaded.named_files = std::move(files);
    loaded.edited = is_broken_seal(toml_text);
    return loaded;
  } catch (const ReadFailure& failure) {
    return usage_error(failure.what());
  }
}

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> kScenes = read_builtin_scenes();
  return kScenes;
}

Result<LoadedScene> load_scene(const std::string& name_or_path,
                               std::span<const std::string> overrides) {
  const std::vector<BuiltinScene>& builtin = builtin_scenes();
  const std::vector<std::string_view> names = names_of(builtin, &BuiltinScene::name);
  const Result<std::optional<std::size_t>> index = find_builtin(name_or_path, "scene", names);
  if (!index) return index.error();
  if (*index) {
    const BuiltinScene& scene = builtin[**index];
    return parse_scene(scene.toml_text, scene.name + " (built in)", overrides);
  }
  return load_file(name_or_path, overrides);
}

}  // namespace hapticwall::file
