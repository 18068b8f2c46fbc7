// A bus on which this process is the device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"

namespace hapticwall::device::hid {

enum class RequestKind : std::uint8_t {
  kOutput,      // a packet of the output endpoint: no answer
  kGetFeature,  // the host waits for answer_get()
  kSet,         // a report on the control endpoint: the host waits for answer_set()
};

struct BusRequest {
  RequestKind kind = RequestKind::kOutput;
  std::uint32_t ticket = 0;  // returned with the answer
  std::uint8_t report_id = 0;
  std::vector<std::uint8_t> bytes;  // data of kOutput and kSet
};

// Carries one device. One thread uses it.
class VirtualBus {
 public:
  VirtualBus() = default;
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;
  virtual ~VirtualBus() = default;

  // The device appears to the host, or disappears. unplug() is idempotent.
  [[nodiscard]] virtual Failure plug() = 0;
  virtual void unplug() = 0;

  // An input report; lost if no program listens.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;

  // The oldest pending request of the host. Never waits.
  [[nodiscard]] virtual std::optional<BusRequest> next_request() = 0;
  // Empty `bytes` refuse the request.
  virtual void answer_get(std::uint32_t ticket, std::span<const std::uint8_t> bytes) = 0;
  virtual void answer_set(std::uint32_t ticket, bool taken) = 0;

  // Nanoseconds of a monotonic clock.
  [[nodiscard]] virtual std::int64_t now_ns() = 0;
  // Returns at `deadline_ns`, or earlier for a request or a signal.
  virtual void wait_until_ns(std::int64_t deadline_ns) = 0;
};

}  // namespace hapticwall::device::hid
