#include "app/table/json_report.h"

#include <cmath>

#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/text.h"

namespace hapticwall::table {
namespace {

constexpr int kIndent = 2;

std::string field_of(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_number_float()) return file::shortest_number(value.get<double>());
  if (!value.is_string()) return value.dump();
  return csv_field(value.get_ref<const std::string&>());
}

}  // namespace

Json json_number(std::optional<double> value) {
  return value && std::isfinite(*value) ? Json(*value) : Json();
}

void add_limits(const Boundary& boundary, Json& object) {
  object["first_settled"] = json_number(boundary.settled.first);
  object["last_settled"] = json_number(boundary.settled.last);
  object["first_failure"] = json_number(boundary.failed.first);
  object["last_failure"] = json_number(boundary.failed.last);
  object["changes"] = boundary.changes;
  object["stable_below_n_per_m"] = json_number(boundary.stable_below_n_per_m);
}

Json boundary_object(const BoundaryPlan& plan, const Boundary& boundary) {
  AlgorithmSettings settings = plan.scene.algorithm;
  settings.index = plan.algorithms.at(boundary.algorithm);
  Json object{{"algorithm", algorithm_label(settings)}};
  if (plan.x) object[plan.x->number.path] = json_number(boundary.x);
  add_limits(boundary, object);
  const bool known = boundary.at_settled.has_value();
  object["displayed_stiffness_n_per_m"] =
      known ? json_number(boundary.at_settled->displayed_stiffness_n_per_m) : Json();
  object["tail_peak_to_peak_m"] =
      known ? json_number(boundary.at_settled->tail_peak_to_peak_m) : Json();
  return object;
}

std::string json_text(const Json& object) {
  return object.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_text(const std::vector<Json>& objects) {
  std::string text;
  for (const Json& object : objects) {
    std::string header;
    std::string line;
    for (const auto& [key, value] : object.items()) {
      const std::string_view separator = header.empty() ? "" : ",";
      header += separator;
      header += key;
      line += separator;
      line += field_of(value);
    }
    if (text.empty()) text = header + '\n';
    text += line + '\n';
  }
  return text;
}

std::string study_json_text(Json head, const std::vector<Json>& rows) {
  head["rows"] = rows;
  return json_text(head);
}

std::string study_csv_text(const Json& head, const std::vector<Json>& rows) {
  std::vector<Json> lines(rows.size(), head);
  for (std::size_t i = 0; i < rows.size(); ++i) lines[i].update(rows[i]);
  return csv_text(lines);
}

}  // namespace hapticwall::table
