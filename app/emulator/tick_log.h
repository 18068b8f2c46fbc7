// What happened at the device, tick by tick: for those who compare it with what a host recorded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "core/result.h"
#include "device/emulator/firmware_emulator.h"

namespace hapticwall::emulator {

struct TickRow {
  std::uint64_t time_us = 0;  // since the start, of the device's clock as long as it kept its power
  std::uint16_t sequence = 0;
  bool plugged = false;
  bool enabled = false;
  std::uint16_t acknowledged = 0;  // sequence of the last command accepted
  std::array<double, device::hid::kMostAxes> true_position_m{};
  std::array<double, device::hid::kMostAxes> force_n{};  // at the amplifiers from this tick on
};

// At the tick that has just passed.
[[nodiscard]] TickRow row_of(const device::hid::FirmwareEmulator& device);

// Kept in memory and written at the end, so that no disk disturbs a tick.
class TickLog {
 public:
  void take(const TickRow& row) { rows_.push_back(row); }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  // CSV with a header; numbers read back to the same double.
  [[nodiscard]] std::string text() const;

 private:
  std::deque<TickRow> rows_;
};

}  // namespace hapticwall::emulator
