// No stabilising algorithm: the wall's force as it is, so that the hold's energy is felt.
#pragma once

#include "core/stabiliser/stabiliser.h"

namespace hapticwall {

// F_d = F_e. Source: paper, section 2.3 (Figure 4). Realtime-safe: yes.
class NoStabiliser {
 public:
  static constexpr AlgorithmDescription kDescription{
      "none",
      "None",
      "the wall's force as computed: the zero-order hold feeds energy to the hand",
      {},
      "F_d(k) = F_e(k)"};

  void configure(const StabiliserContext& /*context*/) {}
  void reset() {}
  [[nodiscard]] double step(const StabiliserInput& input) { return input.wall_force_n; }
};

}  // namespace hapticwall
