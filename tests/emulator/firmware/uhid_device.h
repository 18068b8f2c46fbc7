// The virtual bus of the Linux kernel, /dev/uhid: every program of this machine sees the device.
// Realtime-safe: no, none of it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/result.h"
#include "device/link/report.h"
#include "tests/emulator/firmware/virtual_bus.h"

namespace hapticwall::device::hid {

// Limits of the kernel, bytes without the terminating zero.
inline constexpr std::size_t kMaxUhidNameBytes = 127;
inline constexpr std::size_t kMaxUhidSerialBytes = 63;

struct HidIdentity {
  std::uint16_t vendor_id = kTestVendorId;
  std::uint16_t product_id = kTestProductId;
  std::string serial = "emulated";                   // at most kMaxUhidSerialBytes bytes
  std::string name = "Haptic Wall emulated device";  // at most kMaxUhidNameBytes bytes
  std::span<const std::uint8_t> descriptor = kReportDescriptor;  // at most 4096 bytes
};

// Returns a bus with the device unplugged; destruction unplugs it. Fails with ErrorKind::kDevice.
//
// It differs from a real bus in two ways: a write of the host never waits and may be lost, and the
// kernel drops reports without bytes or with an unknown id.
[[nodiscard]] Result<std::unique_ptr<VirtualBus>> open_uhid(const HidIdentity& identity);

}  // namespace hapticwall::device::hid
