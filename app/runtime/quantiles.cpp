#include "app/runtime/quantiles.h"

#include <algorithm>

namespace hapticwall::runtime {

Quantiles quantiles(std::vector<std::int64_t> values_ns) {
  if (values_ns.empty()) return {};
  std::sort(values_ns.begin(), values_ns.end());
  return quantiles_of(values_ns.size(), [&](std::uint64_t rank) { return values_ns[rank - 1]; });
}

}  // namespace hapticwall::runtime
