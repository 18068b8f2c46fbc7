// The raw reports of a device that does not speak docs/hid-protocol.md, as a table: where a
// position stands, and where a force goes. Numbers alone; device/port reads and writes the bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace hapticwall {

// A number in a report, little endian.
enum class FieldType : std::uint8_t { kI8, kU8, kI16, kU16, kI32, kU32, kF32 };

struct FieldTypeText {
  std::string_view name;  // in a device file
  std::size_t bytes;
};
// Types in the order of FieldType.
inline constexpr std::array<FieldTypeText, 7> kFieldTypes{
    {{"i8", 1}, {"u8", 1}, {"i16", 2}, {"u16", 2}, {"i32", 4}, {"u32", 4}, {"f32", 4}}};

[[nodiscard]] constexpr std::size_t bytes_of(FieldType type) {
  return kFieldTypes.at(static_cast<std::size_t>(type)).bytes;
}

// One number of an axis in a report.
struct ReportField {
  std::size_t offset = 0;  // behind the id of the report
  FieldType type = FieldType::kI16;
  // Size of one unit: metres, or newtons towards growing positions. Not 0; a negative one turns the
  // axis around.
  double per_unit = 1.0;
  double clamp = 0.0;  // of a force, units; 0: the range of the type

  friend bool operator==(const ReportField&, const ReportField&) = default;
};

inline constexpr std::size_t kMaxDialectAxes = 2;

// A raw report. An axis without a field reads as position 0, or gets no force.
struct ReportLayout {
  std::uint8_t id = 0;    // 0: the reports have none
  std::size_t bytes = 0;  // without the id, 1 to kMaxDialectBytes
  std::array<std::optional<ReportField>, kMaxDialectAxes> axes;

  friend bool operator==(const ReportLayout&, const ReportLayout&) = default;
};

inline constexpr std::size_t kMaxDialectBytes = 64;

struct Dialect {
  std::uint16_t usage_page = 0;    // of the interface; 0: any
  ReportLayout in;                 // from the device
  ReportLayout out;                // to the device
  bool reports_on_change = false;  // silence means that the handle rests
  int keep_alive_ms = 10;          // the largest time between two commands, 1 to 20

  friend bool operator==(const Dialect&, const Dialect&) = default;
};

}  // namespace hapticwall
