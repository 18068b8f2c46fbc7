// --device: the simulator, a device that speaks docs/hid-protocol.md or a dialect, a force-feedback
// wheel, or a device behind a shared library.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "app/file/scene/device_file.h"
#include "core/result.h"
#include "core/scene.h"
#include "device/port/impulse_engine.h"
#include "device/port/plugin_port.h"
#include "device/port/wheel_port.h"

namespace hapticwall::command {

inline constexpr const char* kSimulator = "sim";

using HardwareOptions =
    std::variant<device::ImpulseEngineOptions, device::WheelOptions, device::PluginDevice>;

struct DeviceChoice {
  std::optional<HardwareOptions> hardware{};             // nullopt: the simulator
  std::optional<file::DeviceDescription> description{};  // from the device file, if one is named
};

// True if `text` names a device behind a library: "plugin:FILE.so".
[[nodiscard]] bool names_device_plugin(std::string_view text);

// The library, device file or node that `text` names; "" without one.
[[nodiscard]] std::string file_of_device(const std::string& text);

// "sim", "ie2000", "ff", or one of these two with ":PATH", a path that 'hapticwall devices' lists,
// or a device file: a built-in name or NAME.toml; or "plugin:FILE.so", which is loaded and runs
// code of the library. Realtime-safe: no.
[[nodiscard]] Result<DeviceChoice> parse_device_choice(const std::string& text);

// The options of a device file without [ff].
[[nodiscard]] device::ImpulseEngineOptions described_by(const file::DeviceDescription& description);

// Refuses a device for commands that run on the simulator only (exit status 3).
[[nodiscard]] Failure check_simulator(const std::string& command, const std::string& device);

// The closed device, for a session that starts at the position of `scene`.
[[nodiscard]] std::unique_ptr<device::Device> make_device(const HardwareOptions& hardware,
                                                          const Scene& scene);

}  // namespace hapticwall::command
