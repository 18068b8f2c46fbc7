// The lines of a recording's CSV, read back (csv.cpp writes them).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/file/recording_writer.h"
#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::file {

// Which recording a header line (without its end) is of. The error has no place yet: the caller
// puts "NAME.csv:1: " in front of it.
[[nodiscard]] Result<MoreColumns> parse_csv_header(std::string_view line);

// One row (without its line end). Nothing, or what is wrong with it, without a place; `sample` is
// good for nothing then. Numbers as std::from_chars takes them, whatever the locale, and finite.
// What the columns do not hold is zero. `y`: the same tick of the second axis, where the columns
// have one; may be null.
[[nodiscard]] std::optional<std::string> parse_csv_row(std::string_view line, MoreColumns columns,
                                                       Sample& sample, Sample* y = nullptr);

}  // namespace hapticwall::file
