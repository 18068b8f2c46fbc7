// A force-feedback wheel or stick of the kernel: which ones there are, and one that is open. Linux.
// Realtime-safe: no, none of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "device/port/event_node.h"

namespace hapticwall::device::evdev {

// The device ends a force by itself after this time; the writer plays it again every kReplayNs.
inline constexpr std::uint16_t kEffectMs = 100;
// Level of an effect for the full force of the wheel.
inline constexpr std::int16_t kFullLevel = 32767;

// A node with a steering axis (ABS_X) and a constant force.
struct WheelListing {
  NodeListing node;
  std::string name;
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  double max_rate_hz = 0.0;  // max rate of updates, of the endpoint or the model; never 0
  bool rate_is_known = false;
  std::string refusal;  // why this program does not use it; empty: it does
};
[[nodiscard]] std::vector<WheelListing> list_wheels();

// Advice on a kernel older than the repaired hid-pidff; empty for another one. `release` as
// `uname -r` prints it.
[[nodiscard]] std::string kernel_advice(const std::string& release);
[[nodiscard]] std::string kernel_release();

// The axis as the kernel told it when the wheel was opened.
struct WheelAxis {
  std::int32_t min = 0;
  std::int32_t max = 0;
};

struct WheelNews {
  bool gone = false;
  std::uint64_t events = 0;
  std::int64_t latch_ns = 0;  // of the newest event, by the monotonic clock; 0 without one
  // Value of the axis now; empty until the wheel has told it.
  std::optional<std::int32_t> value;
};

// An open wheel with one constant force, of level 0 and not playing. One thread listens, another
// one calls the rest. Replaced in tests. The kernel stops and erases the force when it is
// destroyed.
class WheelNode {
 public:
  WheelNode() = default;
  WheelNode(const WheelNode&) = delete;
  WheelNode& operator=(const WheelNode&) = delete;
  virtual ~WheelNode() = default;

  [[nodiscard]] virtual WheelAxis axis() const = 0;
  // Waits for events, at most `wait_ms`.
  [[nodiscard]] virtual WheelNews listen(int wait_ms) = 0;

  // These are one report to the wheel each, and false if it did not take it: it is gone.
  // Positive levels turn the wheel to the left, to smaller values.
  virtual bool set_level(std::int16_t level) = 0;
  // Plays the force for kEffectMs, or ends it.
  virtual bool play(bool starts) = 0;
  // Sets the gain of all forces of the wheel, other programs' included: all, or none.
  virtual bool set_gain(bool full) = 0;
};

using OpenWheel = std::function<Result<std::shared_ptr<WheelNode>>(const WheelListing&)>;

// Grabs the wheel, ends its autocentring, sets gain, fuzz and flat to 0, and makes the force, which
// may take seconds. Fails with ErrorKind::kDevice: no permission, or another program has it.
[[nodiscard]] Result<std::shared_ptr<WheelNode>> open_wheel(const WheelListing& listing);

}  // namespace hapticwall::device::evdev
