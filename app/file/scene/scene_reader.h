// Reads a scene from a TOML table.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"

namespace hapticwall::file {

// Applies one "KEY=VALUE" of --set to the table. Throws ReadFailure.
void apply_override(toml::table& root, const std::string& override_text);

// Puts the numbers of a device file in the place of its name, and adds to the description where
// they come from. `before`: the table [device] that the name replaces; it keeps its other keys.
// Returns the name or the file's path, "" where the table names none. Throws ReadFailure.
std::string resolve_device(toml::table& root, const toml::table& before, const std::string& origin);

// The same for the hands of both axes. A hand keeps its path, and loses every other number that its
// description omits. Returns the names or paths, "" for an axis that names none. Throws
// ReadFailure.
std::vector<std::string> resolve_hands(toml::table& root, const toml::table& before,
                                       const std::string& origin);

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
