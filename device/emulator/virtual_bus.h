// A bus on which this process is the device: what the host asks for, and what it is told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"

namespace hapticwall::device::hid {

enum class RequestKind : std::uint8_t {
  kOutput,      // a packet of the output endpoint: nobody waits for an answer
  kGetFeature,  // the host waits for answer_get()
  kSet,         // a report through the control endpoint: the host waits for answer_set()
};

struct BusRequest {
  RequestKind kind = RequestKind::kOutput;
  std::uint32_t ticket = 0;  // goes back with the answer
  std::uint8_t report_id = 0;
  std::vector<std::uint8_t> bytes;  // of kOutput and kSet
};

// One device on it, used by one thread.
class VirtualBus {
 public:
  VirtualBus() = default;
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;
  virtual ~VirtualBus() = default;

  // The device appears to the host; and goes, which is harmless where it is not there.
  [[nodiscard]] virtual Failure plug() = 0;
  virtual void unplug() = 0;

  // An input report. Where nobody listens it is lost.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;

  // What the host asked for and was not taken yet, in its order. Never waits.
  [[nodiscard]] virtual std::optional<BusRequest> next_request() = 0;
  // No bytes: the report is refused.
  virtual void answer_get(std::uint32_t ticket, std::span<const std::uint8_t> bytes) = 0;
  virtual void answer_set(std::uint32_t ticket, bool taken) = 0;

  // Nanoseconds of a clock that never goes back.
  [[nodiscard]] virtual std::int64_t now_ns() = 0;
  // Returns at `deadline_ns`, or before it when there may be a request or a signal came.
  virtual void wait_until_ns(std::int64_t deadline_ns) = 0;
};

}  // namespace hapticwall::device::hid
