// One table of a study's numbers. It makes the sheet for people and JSON and CSV for programs.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "app/study/study.h"
#include "app/table/json_report.h"
#include "app/table/text_table.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::study {

using table::Align;
using table::Json;

// `null` for a value that does not apply or is not finite.
inline Json json_of(double value) { return table::json_number(value); }
inline Json json_of(Verdict verdict) { return verdict_name(verdict); }
inline Json json_of(Integrator value) {
  return kIntegratorNames.at(static_cast<std::size_t>(value));
}
template <typename T>
Json json_of(const T& value) {
  return value;
}
template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? json_of(*value) : Json();
}

// Form of a number in the sheet.
struct NumberForm {
  double scale = 1.0;  // factor from SI to the unit of the column
  int decimals = 0;
  bool scientific = false;
};
inline constexpr NumberForm kAsIs{};
inline constexpr NumberForm kScientific{1.0, 1, true};

template <typename Row>
struct Field {
  std::string_view key;         // key in JSON and CSV
  Json (*value)(const Row&);    // value in SI units
  std::string_view title = {};  // column of the sheet; "": not in the sheet
  std::string_view unit = {};
  NumberForm form = {};
  std::string (*text)(const Row&) = nullptr;  // replaces the cell's text
  Align align = Align::kRight;
};

// "-" for null.
inline std::string cell_text(const Json& value, const NumberForm& form) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return "-";
  const auto number = value.get<double>();
  if (form.scientific) return fmt::format("{:.{}e}", number, form.decimals);
  return table::fixed(number, form.scale, form.decimals);
}

// Parts of an outcome that most studies do not need.
struct OutcomeExtras {
  // Titles of all columns in the order of the sheet; empty: the order of the fields.
  std::span<const std::string_view> order = {};
  Json only_json = Json::object();  // conditions that CSV does not repeat in every line
};

// The fields with a title, in the order of the sheet.
template <typename Row>
[[nodiscard]] std::vector<Field<Row>> columns_of(std::span<const Field<Row>> fields,
                                                 std::span<const std::string_view> order) {
  std::vector<Field<Row>> columns;
  std::ranges::copy_if(fields, std::back_inserter(columns),
                       [](const Field<Row>& field) { return !field.title.empty(); });
  if (!order.empty()) {
    std::ranges::sort(columns, {}, [&](const Field<Row>& field) {
      return std::ranges::find(order, field.title) - order.begin();
    });
  }
  return columns;
}

// The sheet without heading and marks.
template <typename Row>
[[nodiscard]] table::Sheet sheet_of(const std::vector<Field<Row>>& columns,
                                    const std::vector<Row>& rows) {
  table::Sheet sheet;
  sheet.rows.resize(rows.size());
  for (const Field<Row>& field : columns) {
    sheet.columns.push_back({std::string(field.title), std::string(field.unit), field.align});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      sheet.rows[i].push_back(field.text != nullptr ? field.text(rows[i])
                                                    : cell_text(field.value(rows[i]), field.form));
    }
  }
  return sheet;
}

// The sheet without heading and marks, with JSON and CSV. `conditions`: once in JSON, in every line
// of CSV.
template <typename Row>
[[nodiscard]] Outcome outcome_of(std::type_identity_t<std::span<const Field<Row>>> fields,
                                 const Json& conditions, const std::vector<Row>& rows,
                                 const OutcomeExtras& extras = {}) {
  std::vector<Json> objects;
  for (const Row& row : rows) {
    Json& object = objects.emplace_back(Json::object());
    for (const Field<Row>& field : fields) object[std::string(field.key)] = field.value(row);
  }
  Json head = conditions;
  head.update(extras.only_json);
  return {sheet_of(columns_of(fields, extras.order), rows),
          table::study_csv_text(conditions, objects),
          table::study_json_text(head, objects),
          {}};
}

}  // namespace hapticwall::study
