// Where a user's own files are kept, after the XDG base directories.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/result.h"

namespace hapticwall::file {

// A variable of the environment, or nothing where it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;
[[nodiscard]] std::optional<std::string> process_environment(const std::string& name);

// The file of the window's settings. HAPTICWALL_SETTINGS names one, or says "off"; else
// hapticwall/settings.toml in $XDG_CONFIG_HOME, else in $HOME/.config. Empty: none is kept.
[[nodiscard]] std::string settings_path(const Environment& environment);

// Makes the folder of a file, and those above it, for this user alone. Realtime-safe: no.
[[nodiscard]] Failure make_folder_of(const std::string& path);

}  // namespace hapticwall::file
