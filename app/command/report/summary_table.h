// Summaries for people: millimetres, newtons, kN/m, millijoules.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::command {

// What a summary does not hold, and its reader should know.
struct Circumstances {
  std::string realtime_status;  // empty: not in real time
  bool hand_moves_in_tail = false;
};

// True where a script still leads a simulated hand, of either axis, in the second before `end_s`
// (seconds from the session's begin): its way is then in the tail's peak to peak, and the verdict.
// What diverged did so whatever the hand's way.
[[nodiscard]] bool hand_moves_in_tail(const Scene& scene, const Summary& summary, double end_s);

// One line of a summary.
[[nodiscard]] std::string summary_line(std::string_view label, std::string_view text);

// A dozen aligned lines, the verdict first, and one for each circumstance.
[[nodiscard]] std::string summary_lines(const Summary& summary, const Circumstances& circumstances);

// One aligned table, a line an axis of a summary, in the order given. With more than one summary
// the best of a column are marked, axis by axis, and lines below say what best is.
[[nodiscard]] std::string comparison_table(const std::vector<Summary>& summaries);

}  // namespace hapticwall::command
