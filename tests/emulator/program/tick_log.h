// The ticks of the device, to compare with the recording of a host.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "core/result.h"
#include "tests/emulator/firmware/firmware_emulator.h"

namespace hapticwall::emulator {

struct TickRow {
  std::uint64_t time_us = 0;  // since the start; the device's clock while it has power
  std::uint16_t sequence = 0;
  bool plugged = false;
  bool enabled = false;
  std::uint16_t acknowledged = 0;  // sequence of the last accepted command
  std::array<double, device::hid::kMaxAxes> true_position_m{};
  std::array<double, device::hid::kMaxAxes> force_n{};  // at the amplifiers from this tick on
};

// The newest tick.
[[nodiscard]] TickRow row_of(const device::hid::FirmwareEmulator& device);

// Kept in memory until the end, so that the disk delays no tick.
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
