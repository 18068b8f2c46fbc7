#include "app/command/device_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/file/scene/device_file.h"
#include "app/file/text/text.h"
#include "app/runtime/loop/realtime_setup.h"

namespace hapticwall::command {
namespace {

constexpr std::string_view kHardware = "ie2000";
constexpr std::string_view kFileEnding = ".toml";

bool names_a_device_file(const std::string& path) {
  const auto& builtin = file::builtin_devices();
  return path.ends_with(kFileEnding) ||
         std::any_of(builtin.begin(), builtin.end(),
                     [&](const file::BuiltinDevice& device) { return device.name == path; });
}

device::AxisDescription description_of(const file::AxisDescription& axis) {
  return {axis.encoder_m,
          axis.force_limit_n,
          {axis.min_m, axis.max_m, axis.max_speed_m_per_s},
          axis.max_force_rate_n_per_s};
}

device::ImpulseEngineOptions described_by(const file::DeviceDescription& description) {
  device::ImpulseEngineOptions options;
  options.vendor_id = description.vendor_id;
  options.product_id = description.product_id;
  options.serial = description.serial;
  options.name = description.name;
  options.axes[0] = description_of(description.x);
  if (description.y) options.axes[1] = description_of(*description.y);
  return options;
}

}  // namespace

Result<DeviceChoice> parse_device_choice(const std::string& text) {
  if (text == kSimulator) return DeviceChoice{};
  if (text == kHardware) return DeviceChoice{device::ImpulseEngineOptions{}};
  const std::string prefix = std::string(kHardware) + ":";
  if (!text.starts_with(prefix) || text.size() == prefix.size()) {
    return device_error(
        fmt::format("--device {}: it takes sim, ie2000 or ie2000:PATH; 'hapticwall "
                    "devices' lists the connected devices",
                    file::in_quotes(text)));
  }
  const std::string path = text.substr(prefix.size());
  device::ImpulseEngineOptions options;
  options.path = path;
  if (names_a_device_file(path)) {
    const Result<file::DeviceDescription> description = file::load_device(path);
    if (!description) return description.error();
    options = described_by(*description);
  }
  return DeviceChoice{options};
}

Failure check_simulator(const std::string& command, const std::string& device) {
  const Result<DeviceChoice> choice = parse_device_choice(device);
  if (!choice) return choice.error();
  if (!choice->hardware) return {};
  return device_error(
      fmt::format("--device {}: '{}' runs on the simulator only; 'hapticwall run' and the "
                  "window drive a device",
                  file::in_quotes(device), command));
}

std::unique_ptr<device::Device> make_device(const device::ImpulseEngineOptions& hardware,
                                            const Scene& scene) {
  device::ImpulseEngineOptions options = hardware;
  options.start_m.fill(scene.x().device.start_m);
  options.prepare_thread = runtime::set_up_device_thread;
  return device::make_impulse_engine(options);
}

}  // namespace hapticwall::command
