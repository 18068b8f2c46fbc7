// The emulated device on a bus, in real time.
#pragma once

#include <cstdint>
#include <functional>

#include "core/result.h"
#include "tests/emulator/firmware/firmware_emulator.h"
#include "tests/emulator/firmware/virtual_bus.h"

namespace hapticwall::emulator {

struct LoopSettings {
  std::uint64_t duration_us = 0;  // 0: until stopped
  // Shifts the tick once, by at most half a tick, so that the first enabling command lies in the
  // middle between two ticks. Host and device then stay in step, and a session is repeatable.
  bool in_step = false;
};

struct LoopStats {
  std::uint64_t ticks = 0;
  std::uint64_t late_ticks = 0;         // more than a tick late: their reports were not sent
  std::uint64_t commands = 0;           // taken from the bus
  std::int64_t largest_latency_ns = 0;  // of a tick after its deadline
};

class DeviceLoop {
 public:
  // `device` and `bus` must outlive the loop.
  DeviceLoop(device::hid::FirmwareEmulator& device, device::hid::VirtualBus& bus,
             const LoopSettings& settings);

  // Called after every tick.
  std::function<void()> on_tick;
  // Called at least once a tick.
  std::function<bool()> should_stop;

  // Plugs the device in and follows the clock, with tick k at k ticks after now; unplugs it at the
  // end. Fails if the bus refuses the device.
  [[nodiscard]] Failure run();

  [[nodiscard]] const LoopStats& stats() const { return stats_; }

 private:
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] std::int64_t deadline_ns() const;
  [[nodiscard]] Failure keep_plugged();
  void take_requests();
  void take(const device::hid::BusRequest& request);
  void come_in_step(const device::hid::BusRequest& request);
  void pass_ticks();

  device::hid::FirmwareEmulator& device_;
  device::hid::VirtualBus& bus_;
  LoopSettings settings_;
  LoopStats stats_;
  std::int64_t start_ns_ = 0;
  std::int64_t tick_ns_ = 0;
  bool plugged_ = false;
  bool in_step_ = false;
};

}  // namespace hapticwall::emulator
