// Virtual walls on one axis: F_e = max(0, K p + B v) while p > 0, else 0, summed over the walls
// (paper, Eq. 11; a wall pushes, it never pulls).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/scene.h"

namespace hapticwall {

// A trivially copyable list of walls, sorted by position: the handle meets the first one first.
class WallSet {
 public:
  WallSet() = default;
  // Takes the first kMaxWalls. Walls at one position keep their order. Realtime-safe: yes.
  explicit WallSet(std::span<const WallSettings> walls) {
    for (const WallSettings& wall : walls.first(std::min(walls.size(), kMaxWalls))) {
      std::size_t place = count_++;
      for (; place > 0 && walls_[place - 1].position_m > wall.position_m; --place) {
        walls_[place] = walls_[place - 1];
      }
      walls_[place] = wall;
    }
  }

  [[nodiscard]] std::span<const WallSettings> walls() const { return {walls_.data(), count_}; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const WallSettings& operator[](std::size_t i) const { return walls_[i]; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  // Number of walls that the position is inside. Realtime-safe: yes.
  [[nodiscard]] double contacts(double position_m) const {
    double contacts = 0.0;
    for (const WallSettings& wall : walls()) contacts += position_m > wall.position_m ? 1.0 : 0.0;
    return contacts;
  }
  friend bool operator==(const WallSet&, const WallSet&) = default;

 private:
  std::array<WallSettings, kMaxWalls> walls_{};
  std::size_t count_ = 0;
};

struct WallContact {
  double force_n = 0.0;        // F_e
  double penetration_m = 0.0;  // into the outermost wall; negative in front of it; 0 without a wall
  bool in_contact = false;     // penetration > 0
};

// The forces of all walls that the position is inside add up. The loop ends at the first wall in
// front of the handle. Realtime-safe: yes.
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

// The force of all springs together when they hold `energy_j` ≥ 0. Realtime-safe: yes.
[[nodiscard]] inline double spring_force(const WallSet& walls, double energy_j) {
  double force_n = 0.0;
  double stiffness_n_per_m = 0.0;
  for (std::size_t i = 0; i < walls.count(); ++i) {
    stiffness_n_per_m += walls[i].stiffness_n_per_m;
    if (i + 1 == walls.count()) break;
    // Up to the next wall the force rises to next_n and the springs store gap_j.
    const double gap_m = walls[i + 1].position_m - walls[i].position_m;
    const double next_n = force_n + stiffness_n_per_m * gap_m;
    const double gap_j = 0.5 * (force_n + next_n) * gap_m;
    if (!(energy_j > gap_j)) break;
    energy_j -= gap_j;
    force_n = next_n;
  }
  return std::sqrt(force_n * force_n + 2.0 * stiffness_n_per_m * energy_j);
}

}  // namespace hapticwall
