// The hand of a recording: how it is led through the recorded positions (hand_rerun.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/plant/hand_path.h"
#include "core/plant/plant_model.h"
#include "core/scene.h"

namespace hapticwall::session {

// Moves the hand of a plant through recorded positions.
class RecordedHand {
 public:
  // `positions_m`: at the ticks from `first_tick` on; at least one.
  RecordedHand(const Scene& scene, std::uint64_t first_tick, std::vector<double> positions_m);

  // The position at the tick after the last one, for a recording that goes on. Append it before the
  // hand is led there.
  void append(double position_m) { positions_m_.push_back(position_m); }

  // Call one of them at every tick from 0 on, when the plant or its path is at that tick.
  void lead(PlantModel& plant);
  // True if the path follows recorded positions during this tick, and no script.
  bool lead(HandPath& path);
  [[nodiscard]] bool has_led() const { return has_led_; }

 private:
  [[nodiscard]] std::optional<double> position_m(std::uint64_t tick) const;
  [[nodiscard]] double reached_m(double from_m, double target_m) const;
  [[nodiscard]] double target_m(double from_m, double to_m) const;
  [[nodiscard]] std::optional<double> next_target_m(double from_m);

  HandPath script_;  // one tick ahead of the plant
  double reach_m_;   // max travel of a pointer in a tick
  std::uint64_t first_tick_;
  std::vector<double> positions_m_;
  std::optional<double> start_m_;  // set when the motion to the first position is not the script
  std::uint64_t tick_ = 0;
  bool leads_ = false;
  bool has_led_ = false;
};

// The path of the hand up to `end_tick` in straight pieces. `path` begins at tick 0.
[[nodiscard]] std::vector<PathPiece> pieces_of(RecordedHand hand, HandPath path,
                                               std::uint64_t end_tick);

}  // namespace hapticwall::session
