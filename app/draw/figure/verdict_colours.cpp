#include "app/draw/figure/verdict_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/draw/plot/theme.h"
#include "core/run/metrics.h"

namespace hapticwall::draw {
namespace {

// CIE lightness L*: 90, 80, 71, 60 and 18.
constexpr ImU32 kSettledArea = IM_COL32(208, 231, 227, 255);
constexpr ImU32 kUntouchedArea = IM_COL32(198, 198, 198, 255);
constexpr ImU32 kActiveArea = IM_COL32(126, 178, 226, 255);
constexpr ImU32 kBuzzingArea = IM_COL32(154, 136, 196, 255);
constexpr ImU32 kDivergedArea = IM_COL32(52, 42, 48, 255);

// Colours from the smallest oscillation to the largest.
constexpr std::array<ImVec4, 4> kHot{{{0.99F, 0.88F, 0.55F, 1.0F},
                                      {0.96F, 0.62F, 0.28F, 1.0F},
                                      {0.83F, 0.29F, 0.22F, 1.0F},
                                      {0.46F, 0.09F, 0.24F, 1.0F}}};
// Neighbours of nearly the same amplitude share a colour, so that they are drawn as one.
constexpr double kColourSteps = 48.0;

}  // namespace

ImU32 verdict_area(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSettled:
    case Verdict::kMoving:
      return kSettledArea;
    case Verdict::kNoContact:
      return kUntouchedArea;
    case Verdict::kActive:
      return kActiveArea;
    case Verdict::kBuzzing:
      return kBuzzingArea;
    case Verdict::kDiverged:
      return kDivergedArea;
    case Verdict::kOscillating:
      break;
  }
  return oscillating_colour(kHottestM);
}

ImU32 oscillating_colour(double tail_peak_to_peak_m) {
  const double share = std::log(tail_peak_to_peak_m / kSettledPeakToPeakM) /
                       std::log(kHottestM / kSettledPeakToPeakM);
  const double part = std::round(kColourSteps * std::clamp(share, 0.0, 1.0)) / kColourSteps;
  const double place = part * static_cast<double>(kHot.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kHot.size() - 2);
  return ImGui::ColorConvertFloat4ToU32(mixed(
      kHot.at(below), kHot.at(below + 1), static_cast<float>(place - static_cast<double>(below))));
}

}  // namespace hapticwall::draw
