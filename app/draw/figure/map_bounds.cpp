#include "app/draw/figure/map_bounds.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hapticwall::draw {
namespace {

constexpr float kThinLineWeight = 0.8F;

constexpr std::array<BoundStyle, 6> kBounds{
    {{"K = 2 (b − B) / T, passive", &StabilityBounds::passive_n_per_m, IM_COL32(20, 60, 140, 255)},
     {"stable below, with this hand", &StabilityBounds::stable_n_per_m,
      IM_COL32(120, 40, 150, 255)},
     {"K = (b + B) / (T/2 + t_d), rule for B T/m < 0.1 without a hand",
      &StabilityBounds::rule_n_per_m, IM_COL32(165, 90, 190, 255), kThinLineWeight},
     {"K = 2 f_c / Δ", &StabilityBounds::friction_n_per_m, IM_COL32(0, 120, 90, 255)},
     {"K = F_max / Δ", &StabilityBounds::resolution_n_per_m, IM_COL32(60, 60, 60, 255)},
     {"largest K and B that CHAI3D allows on this device", nullptr, IM_COL32(0, 110, 255, 255)}}};

}  // namespace

std::span<const BoundStyle> bound_styles() { return kBounds; }

std::vector<BoundLines> map_bounds(const StabilityMap& map) {
  std::vector<BoundLines> all;
  const std::vector<CellBounds> cells = cell_bounds(map);
  for (std::size_t i = 0; i < kBounds.size(); ++i) {
    const BoundMember bound = kBounds.at(i).bound;
    std::vector<BoundSegment> lines =
        bound != nullptr ? bound_lines(map, cells, bound) : chai3d_lines(map, cells);
    // Equal lines are drawn once: without a delay and a damped wall the rule is the first bound.
    const bool drawn =
        std::ranges::any_of(all, [&](const BoundLines& other) { return other.lines == lines; });
    if (!lines.empty() && !drawn) all.push_back({i, std::move(lines)});
  }
  return all;
}

}  // namespace hapticwall::draw
