// What is connected, whether it can be used, and why not where it cannot.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "device/hid_description.h"
#include "device/hid_port.h"

namespace hapticwall::command {

struct ListedDevice {
  device::hid::Listing listing;
  device::hid::Obstacle obstacle = device::hid::Obstacle::kNone;
  std::optional<device::hid::DeviceFigures> figures;  // of one that can be used
  std::string problem;                                // why not, in one line
};

struct DeviceList {
  std::vector<ListedDevice> haptic;  // those that speak the protocol, or may
  std::size_t others = 0;            // HID devices of other kinds
};

// Opens what may be a haptic device, asks it what it is, and closes it again: its amplifiers are
// not touched. Realtime-safe: no.
[[nodiscard]] Result<DeviceList> look_at_devices(device::hid::Port& port);

// For people, with the udev rule where permission is what is missing. Realtime-safe: no.
[[nodiscard]] std::string device_list_text(const DeviceList& list);

// An array of objects, with a line end. Realtime-safe: no.
[[nodiscard]] std::string device_list_json(const DeviceList& list);

}  // namespace hapticwall::command
