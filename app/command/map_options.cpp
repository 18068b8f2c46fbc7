#include "app/command/map_options.h"

#include <fmt/format.h>

#include <utility>

#include "app/command/device_choice.h"
#include "core/usage_error.h"

namespace hapticwall::command {

Failure check_map_options(const MapOptions& options) {
  if (!options.output.expectations.empty()) {
    return usage_error(
        "--expect: 'map' has no single summary; 'hapticwall run SCENE --expect EXPR' has");
  }
  if (Failure failed = check_outputs(options.output, {options.scene.scene, options.read}))
    return failed;
  if (options.boundary.empty()) {
    if (options.x.empty() || options.y.empty()) {
      return usage_error(
          "map: it takes --x and --y, each KEY=LO:HI:N or KEY=LO:HI:N:log; or "
          "--boundary");
    }
    if (!options.tolerance.empty()) return usage_error("--tolerance: it is for --boundary");
    if (!options.read.empty() && !options.output.csv.empty()) {
      return usage_error("--read: the cells are in that file already; leave out --csv");
    }
    if (!options.read.empty() && !options.shard.empty()) {
      return usage_error("--read: it takes the whole map; leave out --shard");
    }
    return {};
  }
  for (const auto& [name, value] : {std::pair("--y", &options.y),
                                    {"--shard", &options.shard},
                                    {"--read", &options.read},
                                    {"--plot", &options.output.plot}}) {
    if (!value->empty()) return usage_error(fmt::format("{}: not with --boundary", name));
  }
  return {};
}

Result<Scene> load_map_scene(const MapOptions& options) {
  if (Failure failed = check_simulator("map", options.scene.device)) return *failed;
  Result<file::LoadedScene> loaded = load_headless(options.scene);
  if (!loaded) return loaded.error();
  if (Failure failed = check_unchanging("map", options.scene, *loaded)) return *failed;
  return std::move(loaded->scene);
}

Failure invalid_cell(const std::optional<SceneProblem>& problem) {
  if (!problem) return {};
  return usage_error(fmt::format("a value of the map: {}: {}", problem->key, problem->message));
}

}  // namespace hapticwall::command
