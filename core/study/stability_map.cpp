#include "core/study/stability_map.h"

#include <cmath>

namespace hapticwall {

double MapAxis::value(std::size_t index) const {
  if (index == 0) return low;
  if (index + 1 >= count) return high;
  const double part = static_cast<double>(index) / static_cast<double>(count - 1);
  const double value = logarithmic ? low * std::pow(high / low, part) : low + part * (high - low);
  // Rounding takes a step of 1 off the whole numbers: 23/42 · 42 > 23.
  constexpr double kRounding = 1e-9;
  const double nearest = std::round(value);
  return number.whole && std::abs(value - nearest) < kRounding ? nearest : value;
}

MapMetrics map_metrics(const Summary& summary) {
  return {summary.verdict,           summary.tail_peak_to_peak_m,         summary.tail_force_mean_n,
          summary.tail_force_std_n,  summary.displayed_stiffness_n_per_m, summary.max_penetration_m,
          summary.passivity_margin_j};
}

MapPlace StabilityMap::place(std::size_t cell) const {
  const std::size_t row = cell / x.count;
  return {row / y.count, row % y.count, cell % x.count};
}

Scene StabilityMap::scene_at(std::size_t cell) const {
  const MapPlace at = place(cell);
  Scene one = scene;
  one.algorithm.index = algorithms.at(at.algorithm);
  x.number.set(one, x.value(at.x));
  y.number.set(one, y.value(at.y));
  return one;
}

std::optional<SceneProblem> validate(const StabilityMap& map) {
  constexpr const char* kTooFew = "an axis takes two values or more";
  if (map.x.count < 2) return SceneProblem{map.x.number.path, kTooFew};
  if (map.y.count < 2) return SceneProblem{map.y.number.path, kTooFew};
  // A problem concerns one value, or the order of two. The edges of the grid therefore find all.
  const auto problem_at = [&](std::size_t x, std::size_t y) {
    return validate(map.scene_at(y * map.x.count + x));
  };
  for (std::size_t x = 0; x < map.x.count; ++x) {
    for (const std::size_t y : {std::size_t{0}, map.y.count - 1}) {
      if (auto problem = problem_at(x, y)) return problem;
    }
  }
  for (std::size_t y = 0; y < map.y.count; ++y) {
    for (const std::size_t x : {std::size_t{0}, map.x.count - 1}) {
      if (auto problem = problem_at(x, y)) return problem;
    }
  }
  return std::nullopt;
}

}  // namespace hapticwall
