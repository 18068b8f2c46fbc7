// Steps of T, T/2, T/4, …: a piece of a tick of any length is made of a few of them and a rest that
// is short enough for a Taylor polynomial.
#pragma once

#include <cmath>

#include "core/plant/taylor_polynomial.h"

namespace hapticwall {

// No tick is halved more often than this: 100 ms become 1e-17 s.
inline constexpr int kMostHalvings = 53;

// How often a tick is to be halved until the fastest rate (1/s) is within a Taylor polynomial's
// reach. Realtime-safe: yes.
[[nodiscard]] inline int halvings_within_reach(double rate_per_s, double period_s) {
  int halvings = 0;
  for (double step_s = period_s; rate_per_s * step_s > kTaylorReach && halvings < kMostHalvings;
       step_s *= 0.5) {
    ++halvings;
  }
  return halvings;
}

}  // namespace hapticwall
