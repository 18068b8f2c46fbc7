// A summary as named values, in the order of the promise (docs/command-line.md): JSON, tables and
// --expect all read this.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/summary.h"

namespace hapticwall::command {

// std::monostate is `null`: what does not apply, and what is not a finite number.
using SummaryValue = std::variant<std::monostate, std::string, std::uint64_t, double>;

struct SummaryField {
  std::string key;
  SummaryValue value;
};

// Where there is a second axis, its fields follow with the prefix y_, less those that both share.
[[nodiscard]] std::vector<SummaryField> summary_fields(const Summary& summary);
// What can be asked for of some summary: the fields of one with two axes.
[[nodiscard]] std::vector<SummaryField> all_summary_fields();

// What is wrong with a key that none of them has: with the nearest one, or with all.
[[nodiscard]] std::string unknown_key(std::string_view key);

// "oscillating", "12", "0.0028", "null".
[[nodiscard]] std::string value_text(const SummaryValue& value);

// One object, or an array of them, with a line end.
[[nodiscard]] std::string summary_json(const Summary& summary);
[[nodiscard]] std::string summaries_json(const std::vector<Summary>& summaries);

// A table, a header and a line a summary; `null` is an empty field.
[[nodiscard]] std::string summaries_csv(const std::vector<Summary>& summaries);

}  // namespace hapticwall::command
