// From a TOML table to a scene.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "app/file/scene_file.h"

namespace hapticwall::file {

// Sets one "KEY=VALUE" of --set in the table; throws ReadFailure.
void apply_override(toml::table& root, const std::string& override_text);

// Reads and validates; throws ReadFailure with one line.
[[nodiscard]] LoadedScene read_scene(const toml::table& root, const std::string& origin);

}  // namespace hapticwall::file
