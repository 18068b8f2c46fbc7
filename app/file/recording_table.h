// The table [recording] of a sidecar: how a session went on from its scene.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "app/file/scene_file.h"

namespace hapticwall::file {

// Adds changes, marks and the rest to `loaded`, whose scene has been read out of `root`. Throws
// ReadFailure.
void read_recording(const toml::table& table, const toml::table& root, const std::string& origin,
                    LoadedScene& loaded);

}  // namespace hapticwall::file
