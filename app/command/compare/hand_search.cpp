#include "app/command/compare/hand_search.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "app/command/report/progress.h"
#include "app/command/signals.h"
#include "app/file/text/text.h"
#include "app/study/worst_hand/worst_hand.h"
#include "core/study/worst_hand/worst_hand.h"

namespace hapticwall::command {

Failure check_searched_hands(const std::string& hands) {
  if (hands.empty()) return {};
  const std::string wrong = study::hands::wrong_hands(hands);
  if (wrong.empty()) return {};
  return usage_error(fmt::format("--worst-hand {}: {}", file::in_quotes(hands), wrong));
}

Failure check_hand_search(const Scene& scene, bool is_recording) {
  if (is_recording) {
    return usage_error(
        "--worst-hand: not with a recording, whose hand every row repeats; use 'hapticwall "
        "worst-hand'");
  }
  const auto problem = worst_hand::problem_of(axis_scene(scene, 0), worst_hand::Bounds::kWide);
  if (!problem) return {};
  return usage_error(fmt::format("--worst-hand: {}: {}", problem->key, problem->message));
}

bool search_hands(const HandSearch& search, const std::vector<ComparedAlgorithm>& rows,
                  std::vector<RunSummary>& summaries) {
  const auto hands = file::parsed<std::uint64_t>(search.hands);
  for (std::size_t i = 0; hands && i < rows.size(); ++i) {
    worst_hand::Plan plan{axis_scene(search.scene, 0), *hands};
    plan.scene.algorithm = rows[i].settings;
    Progress progress(fmt::format("hands, {} {}/{}", rows[i].label, i + 1, rows.size()),
                      search.shows_progress);
    const auto found =
        worst_hand::search(plan, {.threads = 0,
                                  .should_stop = [] { return stop_signal() != 0; },
                                  .time_is_up = {},
                                  .progress = [&](double done) { progress.show(done); }});
    if (!found) return false;
    found->put(summaries[i].front());
  }
  return true;
}

}  // namespace hapticwall::command
