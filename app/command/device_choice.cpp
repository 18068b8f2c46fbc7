#include "app/command/device_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/file/plugin/plugin_library.h"
#include "app/file/text/text.h"
#include "app/session/loop/realtime_setup.h"
#include "device/os_threads.h"

namespace hapticwall::command {
namespace {

constexpr std::string_view kHardware = "ie2000";
constexpr std::string_view kWheel = "ff";
constexpr std::string_view kFileEnding = ".toml";
constexpr std::string_view kPlugin = "plugin:";
constexpr std::size_t kShownDigits = 12;  // digits of the SHA-256 in a device's name

bool names_a_device_file(const std::string& path) {
  const auto& builtin = file::builtin_devices();
  return path.ends_with(kFileEnding) ||
         std::any_of(builtin.begin(), builtin.end(),
                     [&](const file::BuiltinDevice& device) { return device.name == path; });
}

device::AxisDescription description_of(const file::AxisDescription& axis) {
  return {axis.encoder_m,
          axis.force_limit_n,
          {axis.min_m, axis.max_m, axis.max_speed_m_per_s,
           axis.mass_kg.value_or(device::MotionLimits{}.mass_kg)},
          axis.max_force_rate_n_per_s};
}

device::ImpulseEngineOptions engine_at(const std::string& path) {
  device::ImpulseEngineOptions options;
  options.path = path;
  return options;
}

device::WheelOptions wheel_of(const std::string& path,
                              const std::optional<file::DeviceDescription>& description) {
  device::WheelOptions options;
  options.path = path;
  if (!description) return options;
  options.path.clear();
  options.vendor_id = description->vendor_id;
  options.product_id = description->product_id;
  options.serial = description->serial;
  options.name = description->name;
  const file::FfDescription& ff = *description->ff;
  options.wheel = {ff.radius_m,
                   ff.travel_deg,
                   ff.torque_nm,
                   ff.sign,
                   ff.rate_hz,
                   ff.delay_s,
                   description->x.force_limit_n,
                   description->x.max_speed_m_per_s,
                   description->x.max_force_rate_n_per_s,
                   ff.delay_date};
  return options;
}

Failure check_description(const std::string& text, const std::string& kind,
                          const file::DeviceDescription& description) {
  if (description.vendor_id == 0) {
    return device_error(fmt::format(
        "--device {}: the file has no table [usb], so it names no device to open; a scene can "
        "name it (device = ...)",
        file::in_quotes(text)));
  }
  if (description.ff.has_value() == (kind == kWheel)) return std::nullopt;
  return device_error(fmt::format(
      "--device {}: {}", file::in_quotes(text),
      description.ff ? "the file has a table [ff], so it is a wheel; write ff:NAME"
                     : "the file has no table [ff], so it is no wheel; write ie2000:NAME"));
}

Result<DeviceChoice> load_device_plugin(const std::string& path) {
  const auto plugin_of = [](const void* symbol) -> const hw_device_plugin& {
    return *static_cast<const hw_device_plugin*>(symbol);
  };
  const Result<file::LibraryBytes> library = file::read_library(path);
  if (!library) return library.error();
  const Result<const void*> symbol = file::load_library(
      *library, "hapticwall_device",
      [&](const void* found) { return device::device_plugin_problem(plugin_of(found)); });
  if (!symbol) return symbol.error();
  Result<device::PluginDevice> plugin = device::describe_plugin(plugin_of(*symbol), path);
  if (!plugin) return plugin.error();
  plugin->name += fmt::format(" [{}]", library->sha256.substr(0, kShownDigits));
  return DeviceChoice{*plugin, {}};
}

// Makes the chosen device, whose threads are set up as in every session.
struct DeviceMaker {
  const Scene& scene;

  std::unique_ptr<device::Device> operator()(device::WheelOptions options) const {
    options.prepare_thread = session::set_up_device_thread;
    return device::make_wheel(options);
  }
  std::unique_ptr<device::Device> operator()(const device::ImpulseEngineOptions& options) const {
    return device::make_impulse_engine(prepared(options));
  }
  std::unique_ptr<device::Device> operator()(const device::PluginDevice& plugin) const {
    return device::make_impulse_engine(
        prepared(device::options_of(plugin)),
        std::make_unique<device::PluginPort>(plugin, device::monotonic_ns), device::monotonic_ns);
  }

  [[nodiscard]] device::ImpulseEngineOptions prepared(device::ImpulseEngineOptions options) const {
    options.start_m.fill(scene.x().device.start_m);
    options.prepare_thread = session::set_up_device_thread;
    return options;
  }
};

}  // namespace

device::ImpulseEngineOptions described_by(const file::DeviceDescription& description) {
  device::ImpulseEngineOptions options;
  options.vendor_id = description.vendor_id;
  options.product_id = description.product_id;
  options.serial = description.serial;
  options.name = description.name;
  options.axes[0] = description_of(description.x);
  if (description.y) options.axes[1] = description_of(*description.y);
  options.dialect = description.dialect;
  options.rate_hz = description.rate_hz;
  if (!options.dialect) return options;
  options.keep_alive_ns = options.dialect->keep_alive_ms * device::kMillisecondNs;
  options.delay_is_known = options.has_clock = false;
  return options;
}

std::string file_of_device(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? "" : text.substr(colon + 1);
}

bool names_device_plugin(std::string_view text) {
  return text.starts_with(kPlugin) && text.size() > kPlugin.size();
}

Result<DeviceChoice> parse_device_choice(const std::string& text) {
  if (text == kSimulator) return DeviceChoice{};
  if (names_device_plugin(text)) return load_device_plugin(text.substr(kPlugin.size()));
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const bool is_whole = colon == std::string::npos || colon + 1 < text.size();
  if (!is_whole || (kind != kHardware && kind != kWheel)) {
    return device_error(fmt::format(
        "--device {}: it takes sim, ie2000, ie2000:PATH, ff, ff:PATH or plugin:FILE.so; "
        "'hapticwall devices' lists the connected devices",
        file::in_quotes(text)));
  }
  const std::string path = colon == std::string::npos ? "" : text.substr(colon + 1);
  std::optional<file::DeviceDescription> description;
  if (names_a_device_file(path)) {
    Result<file::DeviceDescription> loaded = file::load_device(path);
    if (!loaded) return loaded.error();
    description = std::move(*loaded);
    if (Failure failed = check_description(text, kind, *description)) return *failed;
  }
  if (kind == kWheel) return DeviceChoice{wheel_of(path, description), description};
  return DeviceChoice{description ? described_by(*description) : engine_at(path), description};
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

std::unique_ptr<device::Device> make_device(const HardwareOptions& hardware, const Scene& scene) {
  return std::visit(DeviceMaker{scene}, hardware);
}

}  // namespace hapticwall::command
