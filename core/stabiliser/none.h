// No stabilising algorithm: the wall's force as it is, with the energy that the hold adds.
#include "core/stabiliser/law.h"

HAPTICWALL_LAW_BEGIN

// F_d = F_e. Source: paper, section 2.3 (Figure 4).
struct NoStabiliser {
  static constexpr AlgorithmDescription kDescription{
      "none",
      "None",
      "the wall's force as computed: the zero-order hold feeds energy to the hand",
      {},
      "F_d(k) = F_e(k)"};
  static constexpr bool kOnlyPushes = true;

  template <class N>
  struct Parameters {};
  template <class N>
  struct State {};

  static Parameters<double> parameters(const StabiliserContext& /*context*/) { return {}; }

  static Number step(const Parameters<Number>& /*p*/, State<Number>& /*s*/, const Walls& /*walls*/,
                     const LawInput& in) {
    return in.wall_force_n;
  }
};

HAPTICWALL_LAW_END
