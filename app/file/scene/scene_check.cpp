// Validates a scene and reports the place in its file.
#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "app/file/scene/scene_reader.h"
#include "app/file/scene/table_reader.h"

namespace hapticwall::file {
namespace {

// The node of the key, or the nearest enclosing one.
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

// validate() counts the walls of axis x first; a file may list walls in any order.
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

}  // namespace

void check(const Scene& scene, const toml::table& root, const std::string& prefix,
           const std::string& origin) {
  const std::optional<SceneProblem> problem = validate(scene);
  if (!problem) return;
  const std::string key = prefix + in_order_of_file(problem->key, root, prefix);
  throw ReadFailure(
      fmt::format("{}: {}: {}", place_of(node_at(root, key), origin), key, problem->message));
}

}  // namespace hapticwall::file
