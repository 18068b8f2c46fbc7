// A scene as one lane of a batch: which scenes fit, and the start of their lane.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>

#include "core/batch/lane_block.h"
#include "core/plant/one_body.h"
#include "core/scene.h"

namespace hapticwall::batch {

// Lanes of one kind run side by side.
struct LaneKind {
  std::size_t algorithm = 0;  // index in algorithms()
  bool encoder = false;
  bool damped = false;  // the wall

  friend bool operator==(const LaneKind&, const LaneKind&) = default;
};

// The kind of a scene that fits a lane: one body without friction under the exact integrator, at
// most one wall, nothing between command and handle except a force limit. Else nothing.
[[nodiscard]] std::optional<LaneKind> lane_kind(const Scene& scene);

// The plants of the scenes so far: most maps vary no parameter of the plant, and the matrix
// exponential dominates set-up time. For one thread at a time.
class PlantCache {
 public:
  // Valid until the next call.
  [[nodiscard]] const OneBody& plant(const PlantParameters& parameters, double period_s);

 private:
  using Key = std::array<double, 5>;
  static constexpr std::size_t kMaxEntries = 1024;

  std::map<Key, OneBody> plants_;
};

// Sets lane `lane` to tick 0 of `scene`, whose lane_kind() is something.
void set_lane(const Scene& scene, const OneBody& body, std::size_t lane, LaneBlock& block);
// A lane that never moves.
void clear_lane(std::size_t lane, LaneBlock& block);
// Starts the sums of the last second.
void begin_tail(std::size_t lane, LaneState& state);

}  // namespace hapticwall::batch
