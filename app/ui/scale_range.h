// How small and how large everything may be drawn, in per cent of its size as designed.
#pragma once

namespace hapticwall::ui {

inline constexpr int kSmallestScalePercent = 50;
inline constexpr int kLargestScalePercent = 300;

}  // namespace hapticwall::ui
