// Summaries as named values, and as JSON and CSV (docs/command-line.md).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/summary.h"

namespace hapticwall::command {

// std::monostate is `null`: the field does not apply, or its number is not finite.
using SummaryValue = std::variant<std::monostate, std::string, std::uint64_t, double>;

struct SummaryField {
  std::string key;
  SummaryValue value;
};

// The keys of kSummaryKeys, for every axis. Keys of axis y have the prefix y_; those that the axes
// share appear once, and those of a session only if the run was one.
[[nodiscard]] std::vector<SummaryField> summary_fields(const RunSummary& run);
// Every key that the summary of this many axes can have, with a value of its type or null.
[[nodiscard]] std::vector<SummaryField> all_summary_fields(std::size_t axes = 2);

// Message for a key that does not exist; suggests the nearest one or lists all.
[[nodiscard]] std::string unknown_key(std::string_view key);

// "oscillating", "12", "0.0028", "null".
[[nodiscard]] std::string value_text(const SummaryValue& value);

// One object, or an array of them, with a line end.
[[nodiscard]] std::string summary_json(const RunSummary& run);
[[nodiscard]] std::string summaries_json(const std::vector<RunSummary>& runs);

// A header and one line per run; `null` is an empty field. All runs have as many axes.
[[nodiscard]] std::string summaries_csv(const std::vector<RunSummary>& runs);

}  // namespace hapticwall::command
