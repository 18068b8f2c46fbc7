// The tables of a scene, each read by itself: a scene has them, and so has every change in a
// recording.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <string>

#include "app/file/table_reader.h"
#include "core/scene.h"

namespace hapticwall::file {

enum class TableAxis : std::uint8_t { kX, kY };

// A table of axis x holds that of axis y; this is whether it holds anything of its own.
[[nodiscard]] bool is_of_axis_x(const toml::table& table);

// All of these throw ReadFailure for what they cannot take. `prefix`: what stands before the
// table's name, "" or "recording.change[N].". `name`: "device." or "device.y.", with the prefix.
[[nodiscard]] SamplingSettings read_sampling(const toml::table& table, const std::string& origin);
[[nodiscard]] DeviceSettings read_device(const toml::table& table, const std::string& name,
                                         const std::string& origin, TableAxis axis);
[[nodiscard]] HandSettings read_hand(const toml::table& table, const std::string& name,
                                     const std::string& origin, TableAxis axis);
[[nodiscard]] AlgorithmSettings read_algorithm(const toml::table& table, const std::string& prefix,
                                               const std::string& origin);
[[nodiscard]] SimulatorSettings read_simulator(const toml::table& table, const std::string& prefix,
                                               const std::string& origin);
// All walls of the scene, or of a change of it.
void read_walls(TableReader& parent, const std::string& prefix, Scene& scene);

}  // namespace hapticwall::file
