// Readers of single tables of a scene. A scene has these tables, and so has every change in a
// recording.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>

#include "app/file/scene/table_reader.h"
#include "core/scene.h"

namespace hapticwall::file {

// The table of one axis in [device] or [hand], which hold axis y as a table inside that of axis x.
// Null where there is none.
[[nodiscard]] const toml::table* axis_table(const toml::table* table, std::size_t axis);

// All readers throw ReadFailure. `prefix` precedes the name of the table: "" or
// "recording.change[N].".
[[nodiscard]] DeviceSettings read_device(const toml::table& table, const std::string& prefix,
                                         std::size_t axis, const std::string& origin);
[[nodiscard]] HandSettings read_hand(const toml::table& table, std::size_t axis,
                                     const std::string& origin);
[[nodiscard]] AlgorithmSettings read_algorithm(const toml::table& table, const std::string& prefix,
                                               const std::string& origin);
[[nodiscard]] EnvironmentSettings read_environment(const toml::table& table,
                                                   const std::string& prefix,
                                                   const std::string& origin);
[[nodiscard]] EstimatorSettings read_estimator(const toml::table& table, const std::string& prefix,
                                               const std::string& origin);
[[nodiscard]] SimulatorSettings read_simulator(const toml::table& table, const std::string& prefix,
                                               const std::string& origin);
// Replaces all walls of the scene.
void read_walls(TableReader& parent, const std::string& prefix, Scene& scene);

}  // namespace hapticwall::file
