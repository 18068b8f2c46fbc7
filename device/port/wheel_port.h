// The machine's wheels and sticks as a port of devices that speak docs/hid-protocol.md: link,
// threads and judge are those of any device (docs/wheels.md). Linux. Realtime-safe: no, none of it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "device/link/link.h"
#include "device/link/port.h"
#include "device/port/impulse_engine.h"
#include "device/port/wheel_drive.h"
#include "device/port/wheel_node.h"

namespace hapticwall::device {

struct WheelOptions {
  std::string path;  // of a node; empty: the first wheel that fits
  // Vendor 0: any wheel.
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;  // empty: any
  std::string name;    // of the device file; empty: the device's own name
  WheelDescription wheel;
  // See ImpulseEngineOptions::prepare_thread.
  std::function<void()> prepare_thread;
};

// The kernel's wheels; replaced in tests.
struct Wheels {
  std::function<std::vector<evdev::WheelListing>()> list = evdev::list_wheels;
  evdev::OpenWheel open = evdev::open_wheel;
};

// For the link of such a wheel.
[[nodiscard]] ImpulseEngineOptions options_of(const WheelOptions& options);

class WheelPort : public hid::Port {
 public:
  WheelPort(WheelDescription wheel, Wheels wheels, HostClock now_ns);
  ~WheelPort() override;

  // Each call replaces the paths that open() knows. Lists wheels that open() refuses, too.
  Result<std::vector<hid::Listing>> list() override;
  // Two handles share one open wheel. The force ends with the last of them. Fails with
  // ErrorKind::kDevice for a wheel with a refusal, and while a write to the closed wheel lasts.
  Result<std::unique_ptr<hid::Handle>> open(const std::string& path) override;
  // Always kNone: only open() knows.
  hid::Obstacle obstacle(const std::string& path) override;

 private:
  class Connection;
  class WheelHandle;

  const WheelDescription wheel_;
  const Wheels wheels_;
  const HostClock now_ns_;
  std::map<std::string, evdev::WheelListing> listed_;
  std::map<std::string, std::weak_ptr<Connection>> open_;
};

// The wheel behind the link of every device. Default: the wheels and the clock of this machine.
[[nodiscard]] std::unique_ptr<ImpulseEngine> make_wheel(const WheelOptions& options,
                                                        Wheels wheels = {},
                                                        HostClock now_ns = monotonic_ns);

}  // namespace hapticwall::device
