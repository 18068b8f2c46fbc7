// Checks and messages of the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/result.h"

namespace hapticwall::command {

// Function for CLI11's check(): the problem of a value, or "".
using ValueCheck = std::function<std::string(const std::string& text)>;
[[nodiscard]] ValueCheck is_number();  // finite
[[nodiscard]] ValueCheck is_number_within(double min, double max);

// Refuses empty values, which come from unset variables of scripts, and values of flags. Call it
// after adding all options.
void check_values(CLI::App& app);

// `problem`: thrown by program.parse().
[[nodiscard]] Error usage_problem(const CLI::App& program, const CLI::ParseError& problem);

}  // namespace hapticwall::command
