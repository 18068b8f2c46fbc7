// A port to a device that speaks a dialect: the reports of its handles are those of
// docs/hid-protocol.md. Realtime-safe: no, none of it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/dialect.h"
#include "device/link/link.h"
#include "device/link/port.h"

namespace hapticwall::device::hid {

// Data of a device from its device file.
struct DialectDevice {
  Dialect dialect;
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::array<double, kMaxAxes> encoder_m{};  // metres a count; 0 for a missing axis
  double rate_hz = 1000.0;                   // of its reports
};

// The devices of `port` with these numbers, as if they spoke the protocol; they have no INFO
// report.
[[nodiscard]] std::shared_ptr<Port> dialect_port(std::shared_ptr<Port> port,
                                                 const DialectDevice& device, HostClock now_ns);

// `open_port`, with such a port around its port if the options have a dialect.
[[nodiscard]] PortOpener translated(const ImpulseEngineOptions& options, PortOpener open_port,
                                    const HostClock& now_ns);

}  // namespace hapticwall::device::hid
