// Terminal output: results on standard output, everything else on standard error.
#pragma once

#include <string_view>

#include "core/result.h"

namespace hapticwall::command {

// Writes all of `text` to standard output. A closed pipe (`| head -1`) is no failure.
[[nodiscard]] Failure write_output(std::string_view text);
// write_output() to another open file; `name` is for the message.
[[nodiscard]] Failure write_stream(int descriptor, std::string_view name, std::string_view text);

// Writes one line "error: ..." to standard error; returns the exit status.
[[nodiscard]] int report(const Error& error);

// 0, or the error.
[[nodiscard]] inline Result<int> status_of(const Failure& failed) {
  if (failed) return *failed;
  return 0;
}

// Writes one line to standard error.
void tell(std::string_view line);

}  // namespace hapticwall::command
