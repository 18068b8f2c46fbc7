// Raw reports of devices that speak a dialect: a layout, then the report.
#include <algorithm>
#include <bit>
#include <cmath>

#include "device/port/dialect.h"
#include "tests/fuzz/target.h"

namespace hapticwall::fuzz {
namespace {

constexpr std::size_t kLayoutBytes = 4;  // type, offset, bytes, id

// Layout as a device file may have it.
ReportLayout layout_of(Bytes input) {
  ReportLayout layout;
  const auto type = static_cast<FieldType>(input[0] % kFieldTypes.size());
  const std::size_t size = bytes_of(type);
  layout.bytes = size + input[2] % (kMaxDialectBytes - size + 1);
  layout.id = input[3];
  layout.axes[0] = ReportField{input[1] % (layout.bytes - size + 1), type, -0.5};
  return layout;
}

// The position that is read goes out again as a force, in the same units.
Outcome fuzz_one(Bytes input) {
  if (input.size() < kLayoutBytes) return Outcome::kRefused;
  const ReportLayout layout = layout_of(input);
  const Bytes report = input.subspan(kLayoutBytes);
  const auto position_m = device::hid::decode_positions(layout, report);
  const std::size_t id_bytes = layout.id == 0 ? 0 : 1;
  const bool right =
      report.size() == layout.bytes + id_bytes && (id_bytes == 0 || report[0] == layout.id);
  require(position_m.has_value() == right, "a report of its length and id is taken, no other");
  if (!position_m) return Outcome::kRefused;
  device::hid::ForceReport command;
  command.enable = true;
  command.force_n[0] = (*position_m)[0];
  const auto written = device::hid::encode_forces(layout, command);
  require(written.size == layout.bytes + 1 && written.bytes[0] == layout.id, "a report is whole");
  const auto back = device::hid::decode_positions(layout, written.view().subspan(1 - id_bytes));
  const double expected_m = std::isfinite((*position_m)[0]) ? (*position_m)[0] : 0.0;
  require(back && (*back)[0] == expected_m, "a number that is written reads back the same");
  return Outcome::kTaken;
}

const Registered kRegistered({"dialect", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
