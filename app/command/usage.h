// What is wrong with a command line, in one line: what, where, what would be right.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/result.h"

namespace hapticwall::command {

// For CLI11's check(): what is wrong with a value, or "".
using ValueCheck = std::function<std::string(const std::string& text)>;
[[nodiscard]] ValueCheck is_number();  // a finite one
[[nodiscard]] ValueCheck is_number_within(double least, double most);
[[nodiscard]] ValueCheck is_whole_number();  // from 0 on

// An empty value is never right: some variable of a script was not set. To be called when all
// options are there.
void refuse_empty_values(CLI::App& app);

// `problem`: what program.parse() has thrown.
[[nodiscard]] Error usage_problem(const CLI::App& program, const CLI::ParseError& problem);

}  // namespace hapticwall::command
