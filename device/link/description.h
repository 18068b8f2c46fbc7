// Chooses the device of a session among those listed, and describes it from its INFO report and
// from a device file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "device/link/link.h"
#include "device/link/port.h"

namespace hapticwall::device::hid {

// True if a listing is what the options ask for. Realtime-safe: no.
[[nodiscard]] bool fits(const Listing& listing, const ImpulseEngineOptions& options);

// The first listing that fits. After a loss, `known` is the device of the session, and only that
// device is chosen, at any path. Without a serial number its old path is preferred, and required if
// the options name it. Realtime-safe: no.
[[nodiscard]] std::optional<Listing> choose(const std::vector<Listing>& listings,
                                            const ImpulseEngineOptions& options,
                                            const std::optional<Listing>& known);

// A device as its link uses it, after device file and INFO report are merged.
struct DeviceDescription {
  std::string name;
  std::size_t axes = 1;  // 1 or 2
  // Encoder in metres per count, force limit in whole millinewtons; 0 for a missing axis.
  std::array<AxisDescription, kMaxAxes> axis{};
  bool describes_itself = false;  // it has an INFO report
  std::uint32_t firmware = 0;     // 0: unknown

  friend bool operator==(const DeviceDescription&, const DeviceDescription&) = default;
};

// A device with a larger force limit reaches it in kForceRiseS, if its file gives no rate.
inline constexpr double kFreeRiseN = 10.0;
inline constexpr double kForceRiseS = 2e-3;

// Reads INFO from an open device, in at most three attempts, and merges it with the options. Fails
// if INFO is void, or if neither source describes axis x. Realtime-safe: no.
[[nodiscard]] Result<DeviceDescription> describe(const Listing& listing, Handle& handle,
                                                 const ImpulseEngineOptions& options);

}  // namespace hapticwall::device::hid
