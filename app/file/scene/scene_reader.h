// Reads a scene from a TOML table.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "app/file/scene/scene_file.h"

namespace hapticwall::file {

// Applies one "KEY=VALUE" of --set to the table. Throws ReadFailure.
void apply_override(toml::table& root, const std::string& override_text);

// Reads and validates. Throws ReadFailure.
[[nodiscard]] LoadedScene read_scene(const toml::table& root, const std::string& origin);

// Validates a scene that was read from `root`. Throws ReadFailure with the place in the file.
// `prefix`: as in scene_tables.h.
void check(const Scene& scene, const toml::table& root, const std::string& prefix,
           const std::string& origin);

// Adds the table [recording] of a sidecar to `loaded`, whose scene was read from `root`. Throws
// ReadFailure.
void read_recording(const toml::table& table, const toml::table& root, const std::string& origin,
                    LoadedScene& loaded);

}  // namespace hapticwall::file
