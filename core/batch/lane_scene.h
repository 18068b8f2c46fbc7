// A scene as one lane of a batch: which scenes fit, and what their lane starts from.
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
  LaneLaw law = LaneLaw::kNone;
  bool encoder = false;
  bool damped = false;  // the wall

  friend bool operator==(const LaneKind&, const LaneKind&) = default;
};

// The kind of a scene whose every part has lanes: one body without friction under the exact
// integrator, at most one wall, nothing between command and handle but a force limit; else nothing.
[[nodiscard]] std::optional<LaneKind> lane_kind(const Scene& scene);

// The plants of the scenes met so far: most maps vary what is not the plant's, and its matrix is by
// far the dearest part of a set-up. Not for two threads at a time.
class PlantCache {
 public:
  // Valid until the next call.
  [[nodiscard]] const OneBody& plant(const OneBodyParameters& parameters, double period_s);

 private:
  using Key = std::array<double, 5>;
  static constexpr std::size_t kMostEntries = 1024;

  std::map<Key, OneBody> plants_;
};

// Sets lane `lane` to tick 0 of `scene`, whose lane_kind() is something.
void set_lane(const Scene& scene, const OneBody& body, std::size_t lane, LaneBlock& block);
// A lane that rests for ever.
void clear_lane(std::size_t lane, LaneBlock& block);
// The last second begins: forgets what the lane gathered for it so far.
void begin_tail(std::size_t lane, LaneState& state);

}  // namespace hapticwall::batch
