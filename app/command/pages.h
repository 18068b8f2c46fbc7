// The manual page of an installed program, made from the command line itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hapticwall::command {

// troff with the macros of man(7). `program`: with all commands.
[[nodiscard]] std::string manual_page(const CLI::App& program);

}  // namespace hapticwall::command
