#include "core/study/bound_lines.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hapticwall {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Values in the unit of a number of the wall.
struct WallAndBound {
  double wall = kNone;
  double bound = kNone;

  // Negative if the wall is below the bound.
  [[nodiscard]] double excess() const { return wall - bound; }
  // Linear along a logarithmic axis if both are powers of its key.
  [[nodiscard]] double log_excess() const {
    return wall > 0.0 && bound > 0.0 ? std::log(wall / bound) : kNone;
  }
};

struct Corner {
  MapPoint at;
  WallAndBound found;
};

// Fraction of the way from `a` to `b` at which the wall equals the bound.
double part_of_edge(const WallAndBound& a, const WallAndBound& b, bool logarithmic) {
  const double part = a.log_excess() / (a.log_excess() - b.log_excess());
  if (logarithmic && std::isfinite(part)) return part;
  return a.excess() / (a.excess() - b.excess());
}

// Intersection with the edge between two corners, which is parallel to an axis.
std::optional<MapPoint> crossing(const StabilityMap& map, const Corner& a, const Corner& b) {
  if ((a.found.excess() < 0.0) == (b.found.excess() < 0.0)) return std::nullopt;
  const MapAxis& along = a.at.x != b.at.x ? map.x : map.y;
  const double part = part_of_edge(a.found, b.found, along.logarithmic);
  return MapPoint{a.at.x + part * (b.at.x - a.at.x), a.at.y + part * (b.at.y - a.at.y)};
}

// The corners are in circular order.
void append_square(std::vector<BoundSegment>& lines, const StabilityMap& map,
                   const std::array<Corner, 4>& corners) {
  std::vector<MapPoint> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (std::isnan(corners.at(i).found.excess())) return;
    const auto point = crossing(map, corners.at(i), corners.at((i + 1) % corners.size()));
    if (point) crossings.push_back(*point);
  }
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    lines.push_back({crossings[i], crossings[i + 1]});
  }
}

// `found`: the WallAndBound of a cell.
template <typename Found>
void append_lines(std::vector<BoundSegment>& lines, const StabilityMap& map,
                  std::span<const CellBounds> cells, const Found& found) {
  if (cells.empty()) return;
  const auto corner = [&](std::size_t x, std::size_t y) {
    return Corner{{static_cast<double>(x), static_cast<double>(y)},
                  found(cells[y * map.x.count + x])};
  };
  for (std::size_t y = 0; y + 1 < map.y.count; ++y) {
    for (std::size_t x = 0; x + 1 < map.x.count; ++x) {
      append_square(lines, map,
                    {corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)});
    }
  }
}

}  // namespace

std::vector<CellBounds> cell_bounds(const StabilityMap& map) {
  std::vector<CellBounds> cells;
  if (map.scene.x().walls.empty()) return cells;
  cells.reserve(map.x.count * map.y.count);
  Scene last;
  for (std::size_t i = 0; i < map.x.count * map.y.count; ++i) {
    Scene scene = map.scene_at(i);
    WallSettings& wall = scene.x().walls.front();
    // No bound depends on the stiffness, which most maps vary along x.
    const WallSettings own = wall;
    wall.stiffness_n_per_m = 0.0;
    if (cells.empty() || scene != last) {
      cells.push_back({own, stability_bounds(scene, wall, delay_of(scene))});
      last = std::move(scene);
    } else {
      cells.push_back({own, cells.back().bounds});
    }
  }
  return cells;
}

std::vector<BoundSegment> bound_lines(const StabilityMap& map, std::span<const CellBounds> cells,
                                      BoundMember bound) {
  std::vector<BoundSegment> lines;
  append_lines(lines, map, cells, [&](const CellBounds& cell) {
    return WallAndBound{cell.wall.stiffness_n_per_m, (cell.bounds.*bound).value_or(kNone)};
  });
  return lines;
}

std::vector<BoundSegment> chai3d_lines(const StabilityMap& map, std::span<const CellBounds> cells) {
  const double most_n_per_m = map.scene.x().device.chai3d_stiffness_n_per_m.value_or(kNone);
  const double most_n_s_per_m = map.scene.x().device.chai3d_damping_n_s_per_m.value_or(kNone);
  std::vector<BoundSegment> lines;
  append_lines(lines, map, cells, [&](const CellBounds& cell) {
    const bool allowed = cell.wall.damping_n_s_per_m <= most_n_s_per_m;
    return WallAndBound{cell.wall.stiffness_n_per_m, allowed ? most_n_per_m : kNone};
  });
  append_lines(lines, map, cells, [&](const CellBounds& cell) {
    const bool allowed = cell.wall.stiffness_n_per_m <= most_n_per_m;
    return WallAndBound{cell.wall.damping_n_s_per_m, allowed ? most_n_s_per_m : kNone};
  });
  return lines;
}

}  // namespace hapticwall
