// Scenes as TOML files, and the built-in ones.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/mark.h"
#include "core/result.h"
#include "core/scene.h"
#include "core/simulate.h"

namespace hapticwall::file {

// A scene and, where the file is the sidecar of a recording, what is needed to repeat that session.
struct LoadedScene {
  Scene scene;
  std::vector<ScheduledChange> changes;
  std::uint64_t first_recorded_tick = 0;
  std::string not_repeatable_because;  // why a repetition will differ; empty: it will not
  std::vector<Mark> marks;             // of the recording, in order
};

// Parses and validates; `origin` names the text in messages ("scene.toml:12: wall.stiffness_n_per_m
// …"). `overrides` are "KEY=VALUE" texts of --set, applied in order before validation.
[[nodiscard]] Result<LoadedScene> parse_scene(std::string_view toml_text, const std::string& origin,
                                              std::span<const std::string> overrides = {});

// A built-in scene's name, or a path. Refuses what is too large to be a scene.
[[nodiscard]] Result<LoadedScene> load_scene(const std::string& name_or_path,
                                             std::span<const std::string> overrides = {});

struct BuiltinScene {
  std::string name;
  std::string description;
  std::string_view toml_text;
};
[[nodiscard]] const std::vector<BuiltinScene>& builtin_scenes();

// The whole resolved scene as TOML, every number in the shortest form that reads back the same.
[[nodiscard]] std::string scene_to_toml(const Scene& scene);

}  // namespace hapticwall::file
