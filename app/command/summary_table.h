// Summaries for people: millimetres, newtons, kN/m, millijoules.
#pragma once

#include <string>
#include <vector>

#include "core/summary.h"

namespace hapticwall::command {

// A dozen aligned lines, the verdict first. `realtime_status`: a line more where it is not empty.
[[nodiscard]] std::string summary_lines(const Summary& summary, const std::string& realtime_status);

// One aligned table, a line an axis of a summary, in the order given. With more than one summary
// the best of a column are marked, axis by axis, and lines below say what best is.
[[nodiscard]] std::string comparison_table(const std::vector<Summary>& summaries);

}  // namespace hapticwall::command
