#include "core/study/stability_map.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

namespace hapticwall {
namespace {

bool is_one_of(const std::string& path, std::initializer_list<std::string_view> paths) {
  return std::ranges::find(paths, path) != paths.end();
}

bool is_wall(const std::string& path, std::string_view key) {
  return path == "wall." + std::string(key) || path == "wall[0]." + std::string(key);
}

}  // namespace

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

std::optional<Dimensionless> dimensionless(const Scene& scene, const MapAxis& axis,
                                           const MapAxis& other) {
  const std::string& path = axis.number.path;
  const double period_s = 1.0 / scene.sampling.render_rate_hz();
  const double mass_kg = scene.x().device.mass_kg;
  if (path == "device.friction_n") {
    const double encoder_m = scene.x().device.encoder_m.value_or(0.0);
    if (scene.x().walls.empty() || encoder_m == 0.0) return std::nullopt;
    const double count_n = scene.x().walls.front().stiffness_n_per_m * encoder_m;
    const bool constant =
        !is_wall(other.number.path, "stiffness_n_per_m") && other.number.path != "device.encoder_m";
    if (count_n == 0.0 || !constant) return std::nullopt;
    return Dimensionless{"f_c/(K Δ)", 1.0 / count_n};
  }
  if (is_one_of(other.number.path, {"device.mass_kg", "sampling.rate_hz", "sampling.render_every"}))
    return std::nullopt;
  if (is_wall(path, "stiffness_n_per_m")) {
    return Dimensionless{"K T²/m", period_s * period_s / mass_kg};
  }
  if (is_wall(path, "damping_n_s_per_m")) return Dimensionless{"B T/m", period_s / mass_kg};
  if (path == "device.damping_n_s_per_m") return Dimensionless{"b T/m", period_s / mass_kg};
  return std::nullopt;
}

}  // namespace hapticwall
