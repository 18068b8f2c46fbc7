// The virtual bus of the Linux kernel, /dev/uhid: what is plugged in here is a HID device for every
// program of this machine. Realtime-safe: no, none of it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/result.h"
#include "device/emulator/virtual_bus.h"
#include "device/hid_report.h"

namespace hapticwall::device::hid {

// The kernel's room for them, without the terminating zero.
inline constexpr std::size_t kLongestUhidName = 127;
inline constexpr std::size_t kLongestUhidSerial = 63;

struct HidIdentity {
  std::uint16_t vendor_id = kTestVendorId;
  std::uint16_t product_id = kTestProductId;
  std::string serial = "emulated";                   // at most kLongestUhidSerial bytes
  std::string name = "Haptic Wall emulated device";  // at most kLongestUhidName bytes
};

// Not plugged in yet. Fails with ErrorKind::kDevice and one line that says what to do. Leaving
// unplugs.
//
// Two things a real bus does and this one cannot: a host that writes never waits (what the device
// does not take is lost), and a report without bytes or with an unknown id ends in the kernel.
[[nodiscard]] Result<std::unique_ptr<VirtualBus>> open_uhid(const HidIdentity& identity);

}  // namespace hapticwall::device::hid
