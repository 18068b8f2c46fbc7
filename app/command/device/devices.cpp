#include "app/command/device/devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command/commands.h"
#include "app/command/output_file.h"
#include "app/command/report/terminal.h"
#include "app/file/text/text.h"
#include "app/table/json_report.h"
#include "core/units.h"
#include "embedded_rules.h"

namespace hapticwall::command {
namespace {

using device::hid::DeviceDescription;
using device::hid::Listing;
using device::hid::Obstacle;

ListedDevice look_at(device::hid::Port& port, const Listing& listing) {
  ListedDevice device;
  device.listing = listing;
  device.obstacle = port.obstacle(listing.path);
  if (device.obstacle != Obstacle::kNone) {
    device.problem = device::hid::obstacle_text(listing.path, device.obstacle);
    return device;
  }
  const auto handle = port.open(listing.path);
  if (!handle) {
    device.problem = handle.error().message;
    return device;
  }
  const Result<DeviceDescription> description = device::hid::describe(listing, **handle, {});
  if (description) {
    device.description = *description;
  } else {
    device.problem = description.error().message;
  }
  return device;
}

std::string name_of(const Listing& listing) {
  const std::string name =
      listing.manufacturer.empty() ? listing.product : listing.manufacturer + " " + listing.product;
  std::string text =
      fmt::format("ie2000:{}  {:04x}:{:04x}  {}", file::shown(listing.path), listing.vendor_id,
                  listing.product_id, name.empty() ? "(no name)" : file::shown(name));
  if (!listing.serial.empty()) text += "  serial " + file::shown(listing.serial);
  return text;
}

std::string axes_text(const DeviceDescription& description) {
  std::string text = description.axes == 1 ? "one axis" : fmt::format("{} axes", description.axes);
  for (std::size_t axis = 0; axis < description.axes; ++axis) {
    text += fmt::format("{} {:.4g} mm a count, {:.4g} N", axis == 0 ? ":" : ";",
                        description.axis[axis].encoder_m * kMillimetresPerMetre,
                        description.axis[axis].force_limit_n);
  }
  return text;
}

std::string rule_text() {
  std::string text =
      "\nThis rule permits opening it (assets/70-hapticwall.rules). As root, write it to\n"
      "/etc/udev/rules.d/70-hapticwall.rules, then 'udevadm control --reload && udevadm trigger',\n"
      "and plug the device in again:\n\n";
  for (const EmbeddedFile& file : embedded_rules()) text += file.bytes;
  return text;
}

std::string wheel_text(const device::evdev::WheelListing& wheel) {
  const std::string use =
      wheel.refusal.empty()
          ? fmt::format(
                "usable: at most {:.0f} updates a second{}; its torque, travel and delay are "
                "unknown: a device file states them",
                wheel.max_rate_hz, wheel.rate_is_known ? "" : " (a guess)")
          : "not usable: " + wheel.refusal;
  return fmt::format("ff:{}  {:04x}:{:04x}  {}\n  {}\n", wheel.node.path(), wheel.vendor_id,
                     wheel.product_id, file::shown(wheel.name), use);
}

table::Json wheel_object(const device::evdev::WheelListing& wheel, const std::string& advice) {
  return {{"device", "ff:" + wheel.node.path()},
          {"vendor_id", wheel.vendor_id},
          {"product_id", wheel.product_id},
          {"product", wheel.name},
          {"usable", wheel.refusal.empty()},
          {"problem", wheel.refusal.empty() ? table::Json() : table::Json(wheel.refusal)},
          {"max_rate_hz", wheel.max_rate_hz},
          {"kernel_advice", advice.empty() ? table::Json() : table::Json(advice)}};
}

Result<int> list_devices(const OutputOptions& options) {
  Result<OutputFiles> files = OutputFiles::open(options);
  if (!files) return files.error();
  const auto port = device::hid::open_system_port();
  if (!port) return port.error();
  Result<DeviceList> list = look_at_devices(**port);
  if (!list) return list.error();
  list->wheels = device::evdev::list_wheels();
  list->kernel_advice = device::evdev::kernel_advice(device::evdev::kernel_release());
  return status_of(files->write({"", device_list_json(*list), device_list_text(*list)}));
}

}  // namespace

Result<DeviceList> look_at_devices(device::hid::Port& port) {
  const auto listings = port.list();
  if (!listings) return listings.error();
  DeviceList list;
  for (const Listing& listing : *listings) {
    // Opens only devices that --device ie2000 would open. Without a known usage page, another
    // device could be a keyboard, and opening it would take it away from its user.
    if (device::hid::fits(listing, {})) {
      list.haptic.push_back(look_at(port, listing));
    } else {
      ++list.others;
    }
  }
  return list;
}

std::string device_list_text(const DeviceList& list) {
  std::string text = "sim  the simulator\n  usable\n";
  for (const ListedDevice& device : list.haptic) {
    text += name_of(device.listing) + "\n  " +
            (device.description ? "usable: " + axes_text(*device.description)
                                : "not usable: " + file::shown(device.problem, 400)) +
            "\n";
  }
  for (const auto& wheel : list.wheels) text += wheel_text(wheel);
  if (!list.wheels.empty() && !list.kernel_advice.empty()) text += list.kernel_advice + "\n";
  if (list.haptic.empty() && list.wheels.empty()) text += "no haptic device is connected\n";
  if (list.others > 0) {
    text += fmt::format("{} other HID device{} ignored (transport: {})\n", list.others,
                        list.others == 1 ? "" : "s", device::hid::transport_name());
  }
  const bool denied = std::any_of(list.haptic.begin(), list.haptic.end(), [](const auto& device) {
    return device.obstacle == Obstacle::kPermission;
  });
  return denied ? text + rule_text() : text;
}

std::string device_list_json(const DeviceList& list) {
  table::Json array = table::Json::array();
  for (const ListedDevice& device : list.haptic) {
    table::Json object = {
        {"device", "ie2000:" + device.listing.path},
        {"vendor_id", device.listing.vendor_id},
        {"product_id", device.listing.product_id},
        {"serial", device.listing.serial},
        {"manufacturer", device.listing.manufacturer},
        {"product", device.listing.product},
        {"usable", device.description.has_value()},
        {"problem", device.problem.empty() ? table::Json() : table::Json(device.problem)}};
    table::Json axes = table::Json::array();
    for (std::size_t axis = 0; device.description && axis < device.description->axes; ++axis) {
      axes.push_back({{"encoder_m", device.description->axis[axis].encoder_m},
                      {"force_limit_n", device.description->axis[axis].force_limit_n}});
    }
    object["axes"] = axes;
    array.push_back(object);
  }
  for (const auto& wheel : list.wheels) array.push_back(wheel_object(wheel, list.kernel_advice));
  return table::json_text(array);
}

Command add_devices(CLI::App& program) {
  const auto options = std::make_shared<OutputOptions>();
  CLI::App* app = program.add_subcommand(
      "devices", "List the connected devices, whether they are usable, and why not");
  app->add_option("--json", options->json, "Write the list as JSON; - is standard output")
      ->type_name("FILE");
  return {app, [options] { return list_devices(*options); }};
}

}  // namespace hapticwall::command
