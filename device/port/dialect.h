// Reads and writes the raw reports of a dialect (core/dialect.h). No I/O. Realtime-safe: yes, all
// of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/dialect.h"
#include "device/link/report.h"

namespace hapticwall::device::hid {

static_assert(kMaxDialectAxes == kMaxAxes);

// Positions in metres, as told: an f32 may be NaN. nullopt: another length, or another id.
[[nodiscard]] std::optional<std::array<double, kMaxAxes>> decode_positions(
    const ReportLayout& in, std::span<const std::uint8_t> bytes);

// A report to write, with its id in front.
struct RawReport {
  std::size_t size = 0;
  std::array<std::uint8_t, kMaxDialectBytes + 1> bytes{};

  [[nodiscard]] std::span<const std::uint8_t> view() const { return std::span(bytes).first(size); }
};

// The forces of a command, newtons towards growing positions; zero if it does not enable. Other
// bytes of the report are 0.
[[nodiscard]] RawReport encode_forces(const ReportLayout& out, const ForceReport& command);

}  // namespace hapticwall::device::hid
