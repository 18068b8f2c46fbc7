// The completion of an installed program for three shells, made from the command line itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace hapticwall::command {

// A script for one shell: completes commands, options, built-in scenes and algorithms, else files.
// `program`: with all commands.
using CompletionWriter = std::string (*)(const CLI::App& program);

// The writer for `bash`, `zsh` or `fish`; nullptr for another name.
[[nodiscard]] CompletionWriter completion_writer(std::string_view shell);

}  // namespace hapticwall::command
