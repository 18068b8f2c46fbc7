// What the command line says of a map or a boundary, as far as both share it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command/common_options.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::command {

struct MapOptions {
  SceneOptions scene;
  OutputOptions output;
  std::vector<std::string> algorithms;  // empty: all
  // As they were written; empty: not given.
  std::string x;
  std::string y;
  std::string boundary;
  std::string tolerance;
  std::string shard;
  std::string read;
};

// Options that do not go together, and those that are missing.
[[nodiscard]] Failure check_map_options(const MapOptions& options);

// A scene that stays as it is.
[[nodiscard]] Result<Scene> load_map_scene(const MapOptions& options);

// A usage error of validate(), where it has found a problem.
[[nodiscard]] Failure invalid_cell(const std::optional<SceneProblem>& problem);

}  // namespace hapticwall::command
