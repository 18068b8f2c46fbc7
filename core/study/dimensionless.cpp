#include "core/study/dimensionless.h"

#include <algorithm>
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

std::optional<Dimensionless> dimensionless(const Scene& scene, const MapAxis& axis,
                                           const MapAxis& other) {
  const std::string& path = axis.number.path;
  const double period_s = scene.sampling.period_s();
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
  if (is_one_of(other.number.path, {"device.mass_kg", "sampling.rate_hz"})) return std::nullopt;
  if (is_wall(path, "stiffness_n_per_m")) {
    return Dimensionless{"K T²/m", period_s * period_s / mass_kg};
  }
  if (is_wall(path, "damping_n_s_per_m")) return Dimensionless{"B T/m", period_s / mass_kg};
  if (path == "device.damping_n_s_per_m") return Dimensionless{"b T/m", period_s / mass_kg};
  return std::nullopt;
}

}  // namespace hapticwall
