#include "app/draw/figure/map_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/draw/plot/theme.h"
#include "core/run/metrics.h"

namespace hapticwall::draw {
namespace {

constexpr ImU32 kSettled = IM_COL32(203, 226, 222, 255);
constexpr ImU32 kBuzzing = IM_COL32(176, 160, 214, 255);
constexpr ImU32 kDiverged = IM_COL32(52, 42, 48, 255);
// From the smallest oscillation to the largest.
constexpr std::array<ImVec4, 4> kHot{{{0.99F, 0.88F, 0.55F, 1.0F},
                                      {0.96F, 0.62F, 0.28F, 1.0F},
                                      {0.83F, 0.29F, 0.22F, 1.0F},
                                      {0.46F, 0.09F, 0.24F, 1.0F}}};
// Neighbours of nearly the same amplitude share a colour, so that they are drawn as one.
constexpr double kColourSteps = 48.0;

}  // namespace

ImU32 settled_colour() { return kSettled; }
ImU32 buzzing_colour() { return kBuzzing; }
ImU32 diverged_colour() { return kDiverged; }

ImU32 oscillating_colour(double tail_peak_to_peak_m) {
  const double share = std::log(tail_peak_to_peak_m / kSettledPeakToPeakM) /
                       std::log(kHottestM / kSettledPeakToPeakM);
  const double part = std::round(kColourSteps * std::clamp(share, 0.0, 1.0)) / kColourSteps;
  const double place = part * static_cast<double>(kHot.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kHot.size() - 2);
  return ImGui::ColorConvertFloat4ToU32(mixed(
      kHot.at(below), kHot.at(below + 1), static_cast<float>(place - static_cast<double>(below))));
}

ImU32 colour_of(const MapMetrics& figures) {
  if (figures.verdict == Verdict::kSettled) return settled_colour();
  if (figures.verdict == Verdict::kBuzzing) return buzzing_colour();
  if (figures.verdict == Verdict::kDiverged) return diverged_colour();
  return oscillating_colour(figures.tail_peak_to_peak_m.value_or(kHottestM));
}

}  // namespace hapticwall::draw
