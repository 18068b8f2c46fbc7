// The instruction sets of the lanes. Include it before any header of Highway. The program chooses
// the processor's best set at run time.
#pragma once

#include <hwy/detect_targets.h>

// Not in every version of Highway.
#ifndef HWY_AVX3_ZEN4
#define HWY_AVX3_ZEN4 0LL
#endif
#ifndef HWY_AVX3_SPR
#define HWY_AVX3_SPR 0LL
#endif

// Disabled: sets that add no instruction for lanes of doubles, and sets whose vectors have no fixed
// size (SVE, RVV) and cannot be members of a class.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS                                                                   \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3_ZEN4 | HWY_AVX3_SPR | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | \
   HWY_SVE2_128 | HWY_RVV)

#include <hwy/targets.h>
