// The search for a hand that takes energy, beside the rows of `compare`.
#pragma once

#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/result.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::command {

// Refuses a text that is no number of hands. "" is no search.
[[nodiscard]] Failure check_searched_hands(const std::string& hands);

// Refuses a recording, and a scene without such a search.
[[nodiscard]] Failure check_hand_search(const Scene& scene, bool is_recording);

struct HandSearch {
  const Scene& scene;
  const std::string& hands;  // "": none
  bool shows_progress = false;
};

// Puts the numbers of a search into the summary of each row; nothing without a search. False if a
// signal ended it early. Precondition: both checks passed.
[[nodiscard]] bool search_hands(const HandSearch& search,
                                const std::vector<ComparedAlgorithm>& rows,
                                std::vector<RunSummary>& summaries);

}  // namespace hapticwall::command
