// No stabilising algorithm: the wall's force as it is, with the energy that the hold adds.
#pragma once

#include "core/algorithm/algorithm.h"

namespace hapticwall {

// F_d = F_e. Source: paper, section 2.3 (Figure 4).
struct NoAlgorithm {
  static constexpr AlgorithmDescription kDescription{
      "none",
      "None",
      "the wall's force as computed: the zero-order hold feeds energy to the hand",
      {},
      "F_d(k) = F_e(k)"};

  void configure(const AlgorithmContext& /*context*/) {}
  void reset() {}
  double step(const AlgorithmInput& in, std::span<double> /*signals*/) { return in.wall_force_n; }
};

}  // namespace hapticwall
