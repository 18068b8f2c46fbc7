// Summaries for people: millimetres, newtons, kN/m, millijoules.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::command {

// Facts beside the summary that its reader needs.
struct Circumstances {
  std::string realtime_status;  // empty: not in real time
  bool hand_moves_in_tail = false;
};

// True if a script moves a simulated hand, of either axis, in the second before `end_s` (seconds
// since the session began): the tail's peak to peak then includes that motion. False
// for a run that diverged.
[[nodiscard]] bool hand_moves_in_tail(const Scene& scene, const RunSummary& run, double end_s);

// One line of a summary.
[[nodiscard]] std::string summary_line(std::string_view label, std::string_view text);

// A dozen aligned lines, the verdict first, then one for each circumstance.
[[nodiscard]] std::string summary_lines(const RunSummary& run, const Circumstances& circumstances);

// One aligned table with one line per run and axis, in the order given. With more than one run it
// marks the best of each column, axis by axis, and says below how best is defined. The column of a
// search for hands is there if the runs have one. Precondition: `runs` is not empty.
[[nodiscard]] std::string comparison_table(const std::vector<RunSummary>& runs);

}  // namespace hapticwall::command
