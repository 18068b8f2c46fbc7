// --expect: a condition on the summary.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"
#include "core/summary.h"

namespace hapticwall::command {

struct Expectation {
  std::string text;  // as the user wrote it
  std::string key;
  std::string sign;  // < <= = >= >
  std::variant<double, std::string> value;
};

// "KEY<VALUE" with < <= = >= >; an unknown key, operator or word is a usage error.
[[nodiscard]] Result<Expectation> parse_expectation(const std::string& text);
[[nodiscard]] Result<std::vector<Expectation>> parse_expectations(
    const std::vector<std::string>& texts);

// Nullopt if it holds, else one line with the value found. `null` fails every comparison.
[[nodiscard]] std::optional<std::string> unmet(const Expectation& expectation,
                                               const RunSummary& run);

// Prints one line on standard error for each that does not hold; returns the exit status, 0 or 1.
[[nodiscard]] int judge(const std::vector<Expectation>& expectations,
                        std::span<const RunSummary> runs);

}  // namespace hapticwall::command
