#include "core/study/bound_lines.h"

#include <array>
#include <cmath>
#include <limits>

namespace hapticwall {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Below 0 where the wall is softer than the bound, above 0 where it is stiffer; N/m.
double excess(const Scene& scene, BoundMember bound) {
  const WallSettings& wall = scene.walls.front();
  const std::optional<double> limit = stability_bounds(scene, wall, delay_of(scene)).*bound;
  return limit ? wall.stiffness_n_per_m - *limit : kNone;
}

struct Corner {
  MapPoint at;
  double excess;
};

// Where the line crosses the edge between two corners.
std::optional<MapPoint> crossing(const Corner& a, const Corner& b) {
  if ((a.excess < 0.0) == (b.excess < 0.0)) return std::nullopt;
  const double part = a.excess / (a.excess - b.excess);
  return MapPoint{a.at.x + part * (b.at.x - a.at.x), a.at.y + part * (b.at.y - a.at.y)};
}

// The lines through one square, whose corners go round.
void append_square(std::vector<BoundSegment>& lines, const std::array<Corner, 4>& corners) {
  std::vector<MapPoint> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (std::isnan(corners.at(i).excess)) return;
    const auto point = crossing(corners.at(i), corners.at((i + 1) % corners.size()));
    if (point) crossings.push_back(*point);
  }
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    lines.push_back({crossings[i], crossings[i + 1]});
  }
}

}  // namespace

std::vector<BoundSegment> bound_lines(const StabilityMap& map, BoundMember bound) {
  std::vector<BoundSegment> lines;
  if (map.scene.walls.empty()) return lines;
  std::vector<double> excesses(map.x.count * map.y.count);
  for (std::size_t i = 0; i < excesses.size(); ++i) excesses[i] = excess(map.scene_at(i), bound);
  const auto corner = [&](std::size_t x, std::size_t y) {
    return Corner{{static_cast<double>(x), static_cast<double>(y)}, excesses[y * map.x.count + x]};
  };
  for (std::size_t y = 0; y + 1 < map.y.count; ++y) {
    for (std::size_t x = 0; x + 1 < map.x.count; ++x) {
      append_square(lines,
                    {corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)});
    }
  }
  return lines;
}

}  // namespace hapticwall
