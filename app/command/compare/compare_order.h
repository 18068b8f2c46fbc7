// The order of the rows that `compare` prints.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/summary.h"

namespace hapticwall::command {

// The order of --algorithms.
inline constexpr const char* kUnsorted = "none";

struct RowOrder {
  std::string key;          // key of the summary, or kUnsorted; empty: the default order
  bool descending = false;  // true: the largest value of the key comes first
};

// "", "none", "KEY" or "-KEY"; any other word is a usage error.
[[nodiscard]] Result<RowOrder> parse_order(const std::string& text);

// Indices of `runs` in print order; ties keep the order of the list. The default order is by the
// worst verdict of the axes; then the stiffest settled run and the quietest other run come first.
// Missing values come last in either direction.
[[nodiscard]] std::vector<std::size_t> ordered(const std::vector<RunSummary>& runs,
                                               const RowOrder& order);

}  // namespace hapticwall::command
