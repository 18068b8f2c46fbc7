// Algorithms and environments from shared libraries, by the interfaces of hapticwall/plugin.h and
// hapticwall/environment.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

struct PluginFile {
  std::string path;    // as the user gave it
  std::string sha256;  // of the bytes that were loaded
};

// True for a path with a slash, "./mine.so"; the name of an algorithm or environment has none.
[[nodiscard]] bool names_plugin(std::string_view text);

// Loads a plug-in and gives its index in algorithms(); the same path again gives the same index.
// Runs code of the library. Later changes of the file have no effect. Call it before other threads
// start. Realtime-safe: no.
[[nodiscard]] Result<std::size_t> load_plugin(const std::string& path);

// Loads the environment of a plug-in, likewise, and gives its index in environments().
[[nodiscard]] Result<std::size_t> load_environment(const std::string& path);
// nullptr for an environment that was not loaded from a file.
[[nodiscard]] const PluginFile* environment_file(std::size_t environment);

// Loads the file of a plug-in again, as its newest revision. Returns false if the file has not
// changed. Running loops keep the old revision until they receive the new one. Fails, and changes
// nothing, for a file that is not whole or not a replacement (replacement_problem()). One thread
// calls it. Realtime-safe: no.
[[nodiscard]] Result<bool> reload_plugin(std::size_t algorithm);

// nullptr for an algorithm that was not loaded from a file. `revision` as in AlgorithmSettings.
[[nodiscard]] const PluginFile* plugin_file(std::size_t algorithm, std::uint32_t revision = 0);

}  // namespace hapticwall::file
