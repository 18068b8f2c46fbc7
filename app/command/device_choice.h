// What --device names: the simulator, or a device that speaks docs/hid-protocol.md.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "core/scene.h"
#include "device/impulse_engine.h"

namespace hapticwall::command {

inline constexpr const char* kSimulator = "sim";

struct DeviceChoice {
  std::optional<device::ImpulseEngineOptions> hardware;  // nothing: the simulator
};

// "sim", "ie2000", or "ie2000:PATH": PATH is one that 'hapticwall devices' lists, or a device file
// (a name that is built in, or NAME.toml). Realtime-safe: no.
[[nodiscard]] Result<DeviceChoice> parse_device_choice(const std::string& text);

// Commands that only the simulator can do say so (exit status 3).
[[nodiscard]] Failure check_simulator(const std::string& command, const std::string& device);

// The device, not open yet, for a session that begins as `scene` says.
[[nodiscard]] std::unique_ptr<device::Device> make_device(
    const device::ImpulseEngineOptions& hardware, const Scene& scene);

}  // namespace hapticwall::command
