// A device behind a shared library (hapticwall/device_plugin.h) as a port with one device that
// speaks docs/hid-protocol.md: link, threads and judge are those of any device.
// Realtime-safe: no, none of it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "core/result.h"
#include "core/tick/pulse.h"
#include "device/link/link.h"
#include "device/link/port.h"
#include "device/port/include/hapticwall/device_plugin.h"

namespace hapticwall::device {

// Why the program cannot take this plug-in, or "". Reads `abi` and `size` before anything else, and
// calls nothing.
[[nodiscard]] std::string device_plugin_problem(const hw_device_plugin& plugin);

// A loaded library.
struct PluginDevice {
  const hw_device_plugin* plugin = nullptr;  // lives as long as the program
  std::string path;                          // of the library, whose file is the lock of the device
  hw_device_info info{};
  std::string name;  // for people
};

// Calls info(); fails where it does, or gives values out of range.
[[nodiscard]] Result<PluginDevice> describe_plugin(const hw_device_plugin& plugin,
                                                   const std::string& path);

// The newest fault of the library, in words: "read() threw an exception, which is a failed call";
// "" for none. Any thread.
[[nodiscard]] std::string device_plugin_fault();

// Options for the link of such a device.
[[nodiscard]] ImpulseEngineOptions options_of(const PluginDevice& device);

class PluginPort : public hid::Port {
 public:
  PluginPort(PluginDevice device, HostClock now_ns);
  ~PluginPort() override;

  // Lists the one device, without a call of the library.
  Result<std::vector<hid::Listing>> list() override;
  // Two handles share one open(); close() follows the last of them. Keeps other hosts out by a lock
  // on the file of the library. Fails while a call of an earlier open() has not returned.
  Result<std::unique_ptr<hid::Handle>> open(const std::string& path) override;
  // Always kNone: only open() knows.
  hid::Obstacle obstacle(const std::string& path) override;

 private:
  class Connection;
  class PluginHandle;

  const PluginDevice device_;
  const HostClock now_ns_;
  std::weak_ptr<Connection> open_;
  Pulse pulse_;  // of open(): nobody waits for the other calls
};

}  // namespace hapticwall::device
