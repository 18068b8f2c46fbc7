// Virtual walls on one axis: F_e = max(0, K p + B v) while p > 0, else 0, added up over the walls
// (paper, Eq. 11; a wall pushes, it never pulls).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/scene.h"

namespace hapticwall {

// A trivially copyable list of walls, sorted by position: the first one is met first.
class WallSet {
 public:
  WallSet() = default;
  // Takes the first kMaximumWalls. Realtime-safe: yes.
  explicit WallSet(std::span<const WallSettings> walls) {
    for (const WallSettings& wall : walls.first(std::min(walls.size(), kMaximumWalls))) {
      std::size_t place = count_++;
      for (; place > 0 && walls_[place - 1].position_m > wall.position_m; --place) {
        walls_[place] = walls_[place - 1];
      }
      walls_[place] = wall;
    }
  }

  [[nodiscard]] std::span<const WallSettings> walls() const { return {walls_.data(), count_}; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  friend bool operator==(const WallSet&, const WallSet&) = default;

 private:
  std::array<WallSettings, kMaximumWalls> walls_{};
  std::size_t count_ = 0;
};

struct WallContact {
  double force_n = 0.0;        // F_e
  double penetration_m = 0.0;  // into the outermost wall; negative in front of it; 0 without a wall
  bool in_contact = false;     // penetration > 0
};

// Realtime-safe: yes.
[[nodiscard, gnu::always_inline]] inline WallContact evaluate_walls(const WallSet& set,
                                                                    double position_m,
                                                                    double velocity_m_per_s) {
  const auto force_n = [&](const WallSettings& wall, double penetration_m) {
    return std::max(
        0.0, wall.stiffness_n_per_m * penetration_m + wall.damping_n_s_per_m * velocity_m_per_s);
  };
  WallContact contact;
  const std::span<const WallSettings> walls = set.walls();
  if (walls.empty()) return contact;
  contact.penetration_m = position_m - walls.front().position_m;
  contact.in_contact = contact.penetration_m > 0.0;
  if (!contact.in_contact) return contact;
  contact.force_n = force_n(walls.front(), contact.penetration_m);
  for (const WallSettings& deeper : walls.subspan(1)) {
    const double penetration_m = position_m - deeper.position_m;
    if (penetration_m <= 0.0) break;
    contact.force_n += force_n(deeper, penetration_m);
  }
  return contact;
}

// The same for a single wall without damping.
[[nodiscard, gnu::always_inline]] inline WallContact evaluate_undamped_wall(
    const WallSettings& wall, double position_m) {
  WallContact contact;
  contact.penetration_m = position_m - wall.position_m;
  contact.in_contact = contact.penetration_m > 0.0;
  if (contact.in_contact) contact.force_n = wall.stiffness_n_per_m * contact.penetration_m;
  return contact;
}

}  // namespace hapticwall
