// Results for programs: JSON objects, and the same flat as CSV.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapticwall::command {

using Json = nlohmann::ordered_json;

// `null` where there is no value, or none that is finite.
[[nodiscard]] Json json_number(std::optional<double> value);

// With a line end. Names of scenes are the user's: invalid UTF-8 is replaced, never thrown about.
[[nodiscard]] std::string json_text(const Json& object);

// A field of CSV as RFC 4180 has it, in quotes where it must be.
[[nodiscard]] std::string csv_field(std::string_view text);

// A header and a line an object; all have the same keys. `null` is an empty field.
[[nodiscard]] std::string csv_text(const std::vector<Json>& objects);

}  // namespace hapticwall::command
