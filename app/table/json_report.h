// Results for programs, as JSON or as CSV.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/study/boundary.h"

namespace hapticwall::table {

using Json = nlohmann::ordered_json;

// `null` if there is no value or the value is not finite.
[[nodiscard]] Json json_number(std::optional<double> value);

// The extents of settled and failed values, the changes of verdict, and the limit of theory.
void add_limits(const Boundary& boundary, Json& object);

// A boundary as JSON and CSV show it.
[[nodiscard]] Json boundary_object(const BoundaryPlan& plan, const Boundary& boundary);

// JSON text with a line end. Replaces invalid UTF-8, which a scene's name may contain.
[[nodiscard]] std::string json_text(const Json& object);

// A header and one line per object; `null` is an empty field. All objects have the same keys.
[[nodiscard]] std::string csv_text(const std::vector<Json>& objects);

// study_json_text(): `head` with the array "rows". study_csv_text(): one line a row, each with
// `head`.
[[nodiscard]] std::string study_json_text(Json head, const std::vector<Json>& rows);
[[nodiscard]] std::string study_csv_text(const Json& head, const std::vector<Json>& rows);

}  // namespace hapticwall::table
