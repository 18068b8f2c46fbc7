// Validates a scene and reports the place in its file.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "core/scene.h"

namespace hapticwall::file {

// Throws ReadFailure if the scene, which was read from `root`, is invalid. `prefix`: as in
// scene_tables.h.
void check(const Scene& scene, const toml::table& root, const std::string& prefix,
           const std::string& origin);

}  // namespace hapticwall::file
