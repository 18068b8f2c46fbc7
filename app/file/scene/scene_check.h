// What validate() says of a scene, with the place in the file that it is about.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "core/scene.h"

namespace hapticwall::file {

// Throws ReadFailure where the scene, read out of `root`, is not valid. `prefix`: as in
// scene_tables.h.
void check(const Scene& scene, const toml::table& root, const std::string& prefix,
           const std::string& origin);

}  // namespace hapticwall::file
