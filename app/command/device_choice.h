// --device: the simulator, a device that speaks docs/hid-protocol.md, or a force-feedback wheel.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/file/scene/device_file.h"
#include "core/result.h"
#include "core/scene.h"
#include "device/evdev/wheel.h"
#include "device/hid/impulse_engine.h"

namespace hapticwall::command {

inline constexpr const char* kSimulator = "sim";

using HardwareOptions = std::variant<device::ImpulseEngineOptions, device::WheelOptions>;

struct DeviceChoice {
  std::optional<HardwareOptions> hardware{};             // nullopt: the simulator
  std::optional<file::DeviceDescription> description{};  // of a device file
};

// "sim", "ie2000", "ff", or one of these two with ":PATH", a path that 'hapticwall devices' lists,
// or a device file: a built-in name or NAME.toml. Realtime-safe: no.
[[nodiscard]] Result<DeviceChoice> parse_device_choice(const std::string& text);

// Refuses a device for commands that run on the simulator only (exit status 3).
[[nodiscard]] Failure check_simulator(const std::string& command, const std::string& device);

// The closed device, for a session that starts at the position of `scene`.
[[nodiscard]] std::unique_ptr<device::Device> make_device(const HardwareOptions& hardware,
                                                          const Scene& scene);

}  // namespace hapticwall::command
