#include "app/file/scene/dialect_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::uint64_t kMaxId = 255;
constexpr std::uint64_t kMaxKeepAliveMs = 20;  // a position may be as old
constexpr double kMinPerUnit = 1e-12;
constexpr double kMaxPerUnit = 1e3;
constexpr ValueRange kClamp{0.0, 1e9, true};

// Names and units of one direction of a dialect.
struct Direction {
  std::string_view name;
  std::string_view scale;
  std::string_view unit;
  bool is_force;
};
constexpr Direction kFromDevice{"in", "m_per_unit", "m", false};
constexpr Direction kToDevice{"out", "n_per_unit", "N", true};

constexpr std::array<std::string_view, kMaxDialectAxes> kFieldNames{"x", "y"};

std::uint64_t read_count(TableReader& reader, std::string_view key, std::uint64_t min,
                         std::uint64_t max) {
  const std::optional<std::uint64_t> count = reader.count(key);
  if (!count) reader.fail_missing(key, fmt::format("a number from {} to {}", min, max));
  if (*count < min || *count > max) {
    reader.fail(*reader.node(key), key,
                fmt::format("{} is out of range; it takes {} to {}", *count, min, max));
  }
  return *count;
}

std::uint64_t count_or(TableReader& reader, std::string_view key, std::uint64_t fallback,
                       std::uint64_t min, std::uint64_t max) {
  return reader.node(key) == nullptr ? fallback : read_count(reader, key, min, max);
}

// A force needs both signs.
FieldType read_type(TableReader& reader, bool is_force) {
  const std::string_view wanted =
      is_force ? "\"i8\", \"i16\", \"i32\" or \"f32\""
               : "\"i8\", \"u8\", \"i16\", \"u16\", \"i32\", \"u32\" or \"f32\"";
  const std::optional<std::string> name = reader.string("type");
  if (!name) reader.fail_missing("type", wanted);
  const auto* const found =
      std::find_if(kFieldTypes.begin(), kFieldTypes.end(),
                   [&](const FieldTypeText& type) { return type.name == *name; });
  if (found == kFieldTypes.end() || (is_force && name->starts_with('u'))) {
    reader.fail(*reader.node("type"), "type",
                fmt::format("{} is no type here; it takes {}", in_quotes(*name), wanted));
  }
  return static_cast<FieldType>(found - kFieldTypes.begin());
}

double read_scale(TableReader& reader, const Direction& direction) {
  const std::optional<double> scale = reader.number(direction.scale, direction.unit);
  if (!scale) reader.fail_missing(direction.scale, number_in(direction.unit));
  if (std::abs(*scale) >= kMinPerUnit && std::abs(*scale) <= kMaxPerUnit) return *scale;
  reader.fail(
      *reader.node(direction.scale), direction.scale,
      fmt::format("{} is out of range; it takes {} to {} {}, with either sign", number_text(*scale),
                  number_text(kMinPerUnit), number_text(kMaxPerUnit), direction.unit));
}

double read_clamp(TableReader& reader) {
  const std::optional<double> clamp = reader.number("clamp", "units");
  if (!clamp || kClamp.contains(*clamp)) return clamp.value_or(0.0);
  reader.fail(*reader.node("clamp"), "clamp", out_of_range_text(*clamp, kClamp, "units"));
}

ReportField read_field(const toml::table& table, std::string_view name, const std::string& origin,
                       const Direction& direction, std::size_t bytes) {
  TableReader reader(table, fmt::format("{}.{}.", direction.name, name), origin);
  ReportField field;
  field.type = read_type(reader, direction.is_force);
  const std::size_t size = bytes_of(field.type);
  if (size > bytes) {
    reader.fail(*reader.node("type"), "type",
                fmt::format("it has {} bytes, the report has {}", size, bytes));
  }
  field.offset = read_count(reader, "offset", 0, bytes - size);
  field.per_unit = read_scale(reader, direction);
  if (direction.is_force) field.clamp = read_clamp(reader);
  reader.finish();
  return field;
}

ReportLayout read_layout(TableReader& reader, const std::string& origin, const Direction& direction,
                         bool has_y) {
  ReportLayout layout;
  layout.id = static_cast<std::uint8_t>(count_or(reader, "report_id", 0, 0, kMaxId));
  layout.bytes = read_count(reader, "bytes", 1, kMaxDialectBytes);
  for (std::size_t axis = 0; axis < (has_y ? 2U : 1U); ++axis) {
    const std::string_view name = kFieldNames.at(axis);  // the reader keeps it
    const toml::table* field = reader.table(name);
    if (field == nullptr) {
      reader.fail_missing(name, fmt::format("{{ offset, type, {} }}", direction.scale));
    }
    layout.axes.at(axis) = read_field(*field, name, origin, direction, layout.bytes);
  }
  return layout;
}

void write_report(TomlText& out, const Direction& direction, const ReportLayout& layout) {
  out.table(direction.name);
  if (layout.id != 0) out.integer("report_id", layout.id);
  out.integer("bytes", layout.bytes);
}

void write_fields(TomlText& out, const Direction& direction, const ReportLayout& layout) {
  for (std::size_t axis = 0; axis < kMaxDialectAxes; ++axis) {
    const std::optional<ReportField>& field = layout.axes.at(axis);
    if (!field) continue;
    out.table(fmt::format("{}.{}", direction.name, kFieldNames.at(axis)));
    out.integer("offset", field->offset);
    out.string("type", kFieldTypes.at(static_cast<std::size_t>(field->type)).name);
    out.number(direction.scale, field->per_unit);
    if (field->clamp > 0.0) out.number("clamp", field->clamp);
  }
}

}  // namespace

std::optional<Dialect> read_dialect(TableReader& root, const std::string& origin, bool has_y) {
  const toml::table* in = root.table("in");
  const toml::table* out = root.table("out");
  if (in == nullptr && out == nullptr) return std::nullopt;
  if (in == nullptr) root.fail_missing("in", "a table [in] beside [out]");
  if (out == nullptr) root.fail_missing("out", "a table [out] beside [in]");
  Dialect dialect;
  TableReader from(*in, "in.", origin);
  dialect.in = read_layout(from, origin, kFromDevice, has_y);
  dialect.reports_on_change = from.boolean("reports_on_change").value_or(false);
  dialect.usage_page = static_cast<std::uint16_t>(count_or(from, "usage_page", 0, 1, 0xFFFF));
  from.finish();
  TableReader to(*out, "out.", origin);
  dialect.out = read_layout(to, origin, kToDevice, has_y);
  const auto fallback_ms = static_cast<std::uint64_t>(dialect.keep_alive_ms);
  dialect.keep_alive_ms =
      static_cast<int>(count_or(to, "keep_alive_ms", fallback_ms, 1, kMaxKeepAliveMs));
  to.finish();
  return dialect;
}

void write_dialect(TomlText& out, const Dialect& dialect) {
  write_report(out, kFromDevice, dialect.in);
  if (dialect.reports_on_change) out.boolean("reports_on_change", true);
  if (dialect.usage_page != 0) out.integer("usage_page", dialect.usage_page);
  write_fields(out, kFromDevice, dialect.in);
  write_report(out, kToDevice, dialect.out);
  out.integer("keep_alive_ms", static_cast<std::uint64_t>(dialect.keep_alive_ms));
  write_fields(out, kToDevice, dialect.out);
}

}  // namespace hapticwall::file
