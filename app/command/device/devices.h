// The connected devices, and whether they are usable.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "device/link/description.h"
#include "device/link/port.h"
#include "device/port/wheel_node.h"

namespace hapticwall::command {

struct ListedDevice {
  device::hid::Listing listing;
  device::hid::Obstacle obstacle = device::hid::Obstacle::kNone;
  std::optional<device::hid::DeviceDescription> description;  // nullopt: the device is not usable
  std::string problem;                                        // why it is not usable, in one line
};

struct DeviceList {
  std::vector<ListedDevice> haptic;  // devices that speak the protocol, or may
  std::size_t others = 0;            // HID devices of other kinds
  std::vector<device::evdev::WheelListing> wheels{};
  std::string kernel_advice{};  // note about wheels; empty: none
};

// Opens each possible haptic device, reads its description and closes it. Leaves the amplifiers
// off. Realtime-safe: no.
[[nodiscard]] Result<DeviceList> look_at_devices(device::hid::Port& port);

// The list as text for people; includes the udev rule if permission is denied. Realtime-safe: no.
[[nodiscard]] std::string device_list_text(const DeviceList& list);

// An array of objects, with a line end. Realtime-safe: no.
[[nodiscard]] std::string device_list_json(const DeviceList& list);

}  // namespace hapticwall::command
