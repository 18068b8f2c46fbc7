// Runs a group of scenes side by side, from their first tick to their last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/batch/lane_block.h"
#include "core/batch/lane_scene.h"
#include "core/plant/hand_path.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::batch {

// The end of a lane's scene.
struct LaneEnd {
  std::size_t lane = 0;
  std::uint64_t ticks = 0;
  std::optional<std::uint64_t> diverged_at_tick;
  bool has_tail = false;  // it has reached its last second
};

// The summary of a scene, from its lane at its end.
[[nodiscard]] Summary lane_summary(const Scene& scene, const LaneEnd& end, const LaneBlock& block);

// Runs groups one after the other; one per thread.
class LaneGroup {
 public:
  // Called once for every scene at its end; its metrics are in lane `end.lane` of the block.
  using OnEnd = std::function<void(const LaneEnd& end, const LaneBlock& block)>;
  using ShouldStop = std::function<bool()>;

  // At most lane_count() scenes, all of lane_kind() `kind`. False: stopped before the end of all.
  bool run(std::span<const Scene* const> scenes, const LaneKind& kind, const OnEnd& on_end,
           const ShouldStop& should_stop);

 private:
  struct Lane {
    const Scene* scene;
    HandPath path;
    std::uint64_t ticks;
    std::uint64_t tail_begin_tick;
    bool in_tail;  // the last second has begun
    bool running;
  };

  void set_lanes(std::span<const Scene* const> scenes);
  [[nodiscard]] bool any_running() const;
  [[nodiscard]] std::uint64_t stretch_end() const;
  void choose_parts();
  void run_stretch(std::uint64_t end);
  void bend_paths(const LaneState& before);
  void leave_segments();
  void write_path(std::size_t lane);
  void end_lanes(const OnEnd& on_end);
  void end_lane(std::size_t lane, const OnEnd& on_end, std::optional<std::uint64_t> diverged);

  PlantCache plants_;
  LaneBlock block_;
  LaneState before_bend_;
  std::vector<Lane> lanes_;
  LaneParts parts_;
  std::uint64_t tick_ = 0;
};

}  // namespace hapticwall::batch
