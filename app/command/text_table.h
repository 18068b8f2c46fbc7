// Tables for a terminal.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapticwall::command {

// "1.234" of value * factor; "-" where there is none or none that is finite. A rounding error below
// zero is shown as what it is.
[[nodiscard]] std::string fixed(std::optional<double> value, double factor, int digits);

// The same of newtons per metre in kN/m, with two decimals.
[[nodiscard]] std::string kilonewtons_per_metre(std::optional<double> value_n_per_m);

enum class Align : bool { kRight, kLeft };

// Rows of as many cells as there are columns, as aligned lines.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows,
                                  std::span<const Align> columns);

}  // namespace hapticwall::command
