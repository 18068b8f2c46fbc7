// The kernel's input devices, /dev/input/eventN. Linux. Realtime-safe: no, none of it.
#pragma once

#include <linux/input.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace hapticwall::device::evdev {

// A node and what its device can do, from sysfs: the node is not opened, because that may wake the
// device and needs permission.
class NodeListing {
 public:
  explicit NodeListing(std::string event) : event_(std::move(event)) {}  // "event7"

  [[nodiscard]] std::string path() const { return "/dev/input/" + event_; }
  // Name that the device reports; empty if it reports none.
  [[nodiscard]] std::string name() const;
  // `type` is "key", "abs", "ff" …; has("ff", FF_CONSTANT) asks for a constant force. False if it
  // is gone.
  [[nodiscard]] bool has(const std::string& type, unsigned code) const;
  // `which` is "vendor" or "product"; 0 if it tells none.
  [[nodiscard]] std::uint16_t id(const std::string& which) const;
  // Empty if it tells none.
  [[nodiscard]] std::string serial() const;
  // Reports per second that its USB endpoint takes; 0: unknown, or no USB device.
  [[nodiscard]] double output_rate_hz() const;

 private:
  [[nodiscard]] std::string first_line(const std::string& file) const;

  std::string event_;
};

// All nodes, in the order of their numbers.
[[nodiscard]] std::vector<NodeListing> list_nodes();

// An open node. Its errors are the system's words, without the name of the node.
class EventNode {
 public:
  // Opens the node for reading and writing, without waiting. Fails with ErrorKind::kDevice.
  [[nodiscard]] static Result<EventNode> open(const std::string& path);
  EventNode(EventNode&& other) noexcept;
  EventNode& operator=(EventNode&&) = delete;
  // The kernel stops and erases the effects of this node.
  ~EventNode();

  // Makes an effect if its id is -1, and sets the id; else changes it. May sleep.
  [[nodiscard]] Failure upload(ff_effect& effect) const;
  // EV_FF: `code` is an effect, and `value` how often it plays, 0 to stop; or FF_GAIN, 0 to 0xFFFF.
  [[nodiscard]] Failure write(std::uint16_t type, std::uint16_t code, std::int32_t value) const;
  // No other program gets its events; fails if another one has them.
  [[nodiscard]] Failure grab() const;
  // Times of events by the monotonic clock.
  [[nodiscard]] Failure use_monotonic_clock() const;
  [[nodiscard]] Failure get_axis(unsigned code, input_absinfo& axis) const;
  [[nodiscard]] Failure set_axis(unsigned code, const input_absinfo& axis) const;
  // Waits for events, at most `wait_ms`, and drops them all. Returns how many there were of the
  // axis `code`, and the time of the last one in nanoseconds: others are echoes of what was
  // written. Fails once the device is gone.
  struct Events {
    std::uint64_t count = 0;
    std::int64_t last_ns = 0;
  };
  [[nodiscard]] Result<Events> drain(int wait_ms, unsigned code) const;

 private:
  explicit EventNode(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace hapticwall::device::evdev
