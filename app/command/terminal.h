// What the program says: results on standard output, everything else on standard error.
#pragma once

#include <string_view>

#include "core/result.h"

namespace hapticwall::command {

// Writes all of `text` to standard output. A reader that left early (`| head -1`) is no failure.
[[nodiscard]] Failure write_output(std::string_view text);

// One line "error: ..." on standard error, whatever `message` holds; returns the exit status.
[[nodiscard]] int report(const Error& error);

// One line on standard error as it is.
void tell(std::string_view line);

}  // namespace hapticwall::command
