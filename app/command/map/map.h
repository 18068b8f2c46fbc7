// hapticwall map SCENE: a grid over two numbers of a scene, or its stability boundary along
// one.
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
  // Texts as the user wrote them; empty: not given.
  std::string x;
  std::string y;
  std::string boundary;
  std::string tolerance;
  std::string shard;
  std::string read;
};

// The problem of validate() as a usage error.
[[nodiscard]] Failure invalid_cell(const std::optional<SceneProblem>& problem);

// --boundary: finds, writes and prints the boundaries; returns the exit status.
[[nodiscard]] Result<int> run_boundary(const MapOptions& options, Scene scene);

}  // namespace hapticwall::command
