#include "device/port/dialect.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "device/link/little_endian.h"

namespace hapticwall::device::hid {
namespace {

double units_at(std::span<const std::uint8_t> bytes, const ReportField& field) {
  switch (field.type) {
    case FieldType::kI8:
      return get<std::int8_t>(bytes, field.offset);
    case FieldType::kU8:
      return get<std::uint8_t>(bytes, field.offset);
    case FieldType::kI16:
      return get<std::int16_t>(bytes, field.offset);
    case FieldType::kU16:
      return get<std::uint16_t>(bytes, field.offset);
    case FieldType::kI32:
      return get<std::int32_t>(bytes, field.offset);
    case FieldType::kU32:
      return get<std::uint32_t>(bytes, field.offset);
    case FieldType::kF32:
      break;
  }
  return std::bit_cast<float>(get<std::uint32_t>(bytes, field.offset));
}

void put_units(std::span<std::uint8_t> bytes, const ReportField& field, double units) {
  switch (field.type) {
    case FieldType::kI8:
      return put(bytes, field.offset, saturated<std::int8_t>(units));
    case FieldType::kU8:
      return put(bytes, field.offset, saturated<std::uint8_t>(units));
    case FieldType::kI16:
      return put(bytes, field.offset, saturated<std::int16_t>(units));
    case FieldType::kU16:
      return put(bytes, field.offset, saturated<std::uint16_t>(units));
    case FieldType::kI32:
      return put(bytes, field.offset, saturated<std::int32_t>(units));
    case FieldType::kU32:
      return put(bytes, field.offset, saturated<std::uint32_t>(units));
    case FieldType::kF32:
      break;
  }
  put(bytes, field.offset, std::bit_cast<std::uint32_t>(static_cast<float>(units)));
}

// 0 for a force that is not finite: it is a mistake, not a strong force.
double clamped_units(const ReportField& field, double force_n) {
  const double units = force_n / field.per_unit;
  if (!std::isfinite(units)) return 0.0;
  constexpr double kMost = std::numeric_limits<float>::max();
  const double max = field.clamp > 0.0 ? field.clamp : kMost;
  return std::clamp(units, -max, max) + 0.0;  // no force is +0 also by a negative scale
}

}  // namespace

std::optional<std::array<double, kMaxAxes>> decode_positions(const ReportLayout& in,
                                                             std::span<const std::uint8_t> bytes) {
  const std::size_t id_bytes = in.id == 0 ? 0 : 1;
  if (bytes.size() != in.bytes + id_bytes) return std::nullopt;
  if (in.id != 0 && bytes.front() != in.id) return std::nullopt;
  std::array<double, kMaxAxes> position_m{};
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    if (const auto& field = in.axes[axis])
      position_m[axis] = units_at(bytes.subspan(id_bytes), *field) * field->per_unit;
  }
  return position_m;
}

RawReport encode_forces(const ReportLayout& out, const ForceReport& command) {
  RawReport report;
  report.size = out.bytes + 1;
  report.bytes[0] = out.id;
  const auto fields = std::span(report.bytes).subspan(1, out.bytes);
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    const double force_n = command.enable ? command.force_n[axis] : 0.0;
    if (const auto& field = out.axes[axis])
      put_units(fields, *field, clamped_units(*field, force_n));
  }
  return report;
}

}  // namespace hapticwall::device::hid
