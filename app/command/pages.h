// The pages of an installed program: its manual page and its completion for bash, both made from
// the command line itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hapticwall::command {

// troff with the macros of man(7). `program`: with all commands.
[[nodiscard]] std::string manual_page(const CLI::App& program);

// A script for bash: completes commands, options, built-in scenes and algorithms, else files.
[[nodiscard]] std::string bash_completion(const CLI::App& program);

}  // namespace hapticwall::command
