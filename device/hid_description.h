// What a device is, from its own INFO report and from a device file.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/result.h"
#include "device/hid_port.h"
#include "device/link_options.h"

namespace hapticwall::device::hid {

struct DeviceFigures {
  std::string name;
  std::size_t axes = 1;  // 1 or 2
  // Encoder in metres a count, force limit in whole millinewtons; 0 of an axis that there is not.
  std::array<AxisFigures, kMostAxes> axis{};
  bool describes_itself = false;  // it has an INFO report
  std::uint32_t firmware = 0;     // of that

  friend bool operator==(const DeviceFigures&, const DeviceFigures&) = default;
};

// Asks an open device for INFO and puts it together with what the options say. One sentence where
// it is not understood, or where neither says anything. Realtime-safe: no.
[[nodiscard]] Result<DeviceFigures> describe(const Listing& listing, Handle& handle,
                                             const ImpulseEngineOptions& options);

}  // namespace hapticwall::device::hid
