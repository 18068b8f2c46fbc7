// In which order `compare` prints its rows.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/summary.h"

namespace hapticwall::command {

// The order of the list, which --algorithms gives.
inline constexpr const char* kUnsorted = "none";

struct RowOrder {
  std::string key;          // of the summary, or kUnsorted; empty: the usual order
  bool descending = false;  // of a key
};

// "", "none", "KEY" or "-KEY"; any other word is a usage error.
[[nodiscard]] Result<RowOrder> parse_order(const std::string& text);

// Indices of `summaries`, as they are to be printed; ties keep the order of the list. Usual: the
// worst verdict of the axes, then the stiffest of those that settled and the quietest of the others
// first. What has no value stands last in either direction.
[[nodiscard]] std::vector<std::size_t> ordered(const std::vector<Summary>& summaries,
                                               const RowOrder& order);

}  // namespace hapticwall::command
