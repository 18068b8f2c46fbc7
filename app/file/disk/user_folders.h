// The user's folders, by the XDG base directories.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/result.h"

namespace hapticwall::file {

// A variable of the environment; nullopt if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;
[[nodiscard]] std::optional<std::string> process_environment(const std::string& name);

// The file of the window's settings: HAPTICWALL_SETTINGS if set, else hapticwall/settings.json in
// $XDG_CONFIG_HOME or $HOME/.config. Empty, also for "off": no settings are stored.
[[nodiscard]] std::string settings_path(const Environment& environment);

// Creates the folder of a file and its parents, accessible by this user only. Realtime-safe: no.
[[nodiscard]] Failure make_folder_of(const std::string& path);

}  // namespace hapticwall::file
