// The instruction sets that the lanes are compiled for; to be included before anything of Highway.
// The best one that the processor has is chosen while the program runs.
#pragma once

#include <hwy/detect_targets.h>

// Not in every version of Highway.
#ifndef HWY_AVX3_ZEN4
#define HWY_AVX3_ZEN4 0LL
#endif
#ifndef HWY_AVX3_SPR
#define HWY_AVX3_SPR 0LL
#endif

// These have no instruction that lanes of doubles would use and their neighbours lack; vectors
// without a fixed size (SVE, RVV) cannot be members of a class.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS                                                                   \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3_ZEN4 | HWY_AVX3_SPR | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | \
   HWY_SVE2_128 | HWY_RVV)

#include <hwy/targets.h>
