#include "app/file/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/file/scene_reader.h"
#include "app/file/sidecar.h"
#include "app/file/small_file.h"
#include "app/file/table_reader.h"
#include "app/file/text.h"
#include "core/usage_error.h"
#include "embedded_scenes.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kLargestSceneBytes = std::size_t{1} << 20U;

Result<LoadedScene> load_file(const std::string& path, std::span<const std::string> overrides) {
  const std::size_t largest_bytes =
      is_sidecar(path, kRecordingTable) ? kLargestSidecarBytes : kLargestSceneBytes;
  const Result<std::string> text = read_small_file(path, "scene", largest_bytes);
  if (!text) return text.error();
  return parse_scene(*text, path, overrides);
}

std::vector<BuiltinScene> read_builtin_scenes() {
  std::vector<BuiltinScene> scenes;
  for (const EmbeddedFile& embedded : embedded_scenes()) {
    const std::string name = std::filesystem::path(embedded.name).stem().string();
    const Result<LoadedScene> loaded = parse_scene(embedded.bytes, std::string(embedded.name));
    scenes.push_back(
        {name, loaded ? loaded->scene.description : loaded.error().message, embedded.bytes});
  }
  // The references last: they are for checking the program, not for looking at.
  const auto rank = [](const BuiltinScene& scene) {
    return std::pair(scene.name.starts_with("golden-"), std::string_view(scene.name));
  };
  std::sort(scenes.begin(), scenes.end(),
            [&](const BuiltinScene& a, const BuiltinScene& b) { return rank(a) < rank(b); });
  return scenes;
}

}  // namespace

Result<LoadedScene> parse_scene(std::string_view toml_text, const std::string& origin,
                                std::span<const std::string> overrides) {
  try {
    toml::table root = parse_toml(toml_text, origin);
    for (const std::string& text : overrides) apply_override(root, text);
    return read_scene(root, origin);
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
  std::vector<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == name_or_path) {
      return parse_scene(scene.toml_text, scene.name + " (built in)", overrides);
    }
    names.push_back(scene.name);
  }
  std::error_code ignored;
  const bool looks_like_a_path = name_or_path.find_first_of("/.") != std::string::npos;
  if (!looks_like_a_path && !std::filesystem::exists(name_or_path, ignored)) {
    return usage_error(fmt::format("{} is neither a file nor a built-in scene{}; built in: {}",
                                   in_quotes(name_or_path), suggestion(name_or_path, names),
                                   joined(names)));
  }
  return load_file(name_or_path, overrides);
}

}  // namespace hapticwall::file
