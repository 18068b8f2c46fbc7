#include "core/batch/lane_group.h"

#include <algorithm>

#include "core/plant/plant_model.h"
#include "core/simulation/metrics.h"

namespace hapticwall::batch {
namespace {

// Between two calls of should_stop().
constexpr std::uint64_t kMaxTicks = 65536;

using LanePlant = ExactPlant<OneBody, false>;

// One tick of a lane whose path bends within it, by the plant of simulate().
void advance_scalar(std::size_t lane, const LaneState& before, LanePlant& plant, LaneState& after) {
  LanePlant::Motion motion = plant.motion();
  motion.body.position_m = before.motion.position_m[lane];
  motion.body.velocity_m_per_s = before.motion.velocity_m_per_s[lane];
  motion.energy.actuator_work_j = before.account.sums.actuator_work_j[lane];
  motion.energy.viscous_j = before.account.sums.viscous_j[lane];
  motion.energy.hand_work_j = before.account.sums.hand_work_j[lane];
  plant.resume(motion);
  plant.advance(after.motion.force_n[lane]);
  motion = plant.motion();
  after.motion.position_m[lane] = motion.body.position_m;
  after.motion.velocity_m_per_s[lane] = motion.body.velocity_m_per_s;
  after.account.sums.actuator_work_j[lane] = motion.energy.actuator_work_j;
  after.account.sums.viscous_j[lane] = motion.energy.viscous_j;
  after.account.sums.hand_work_j[lane] = motion.energy.hand_work_j;
  after.account.sums.margin_j[lane] =
      std::min(before.account.sums.margin_j[lane], plant.net_work_j(motion));
}

}  // namespace

bool LaneGroup::run(std::span<const Scene* const> scenes, const LaneKind& kind, const OnEnd& on_end,
                    const ShouldStop& should_stop) {
  parts_ = {kind.algorithm, kind.encoder, kind.damped, false, false};
  tick_ = 0;
  set_lanes(scenes);
  while (any_running()) {
    if (should_stop && should_stop()) return false;
    choose_parts();
    run_stretch(stretch_end());
    end_lanes(on_end);
  }
  return true;
}

void LaneGroup::set_lanes(std::span<const Scene* const> scenes) {
  lanes_.clear();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = *scenes[i];
    const std::uint64_t ticks = scene.tick_count();
    lanes_.push_back({&scene, hand_path(scene), ticks,
                      tail_begin_tick(ticks, scene.sampling.rate_hz), false, true});
    set_lane(scene, plants_.plant(plant_parameters(scene), scene.sampling.period_s()), i, block_);
    write_path(i);
  }
  for (std::size_t i = scenes.size(); i < lane_count(); ++i) clear_lane(i, block_);
}

bool LaneGroup::any_running() const {
  return std::any_of(lanes_.begin(), lanes_.end(), [](const Lane& lane) { return lane.running; });
}

// Up to the next event in any lane: its end, its last second, a bend of its path.
std::uint64_t LaneGroup::stretch_end() const {
  std::uint64_t end = tick_ + kMaxTicks;
  for (const Lane& lane : lanes_) {
    if (!lane.running) continue;
    end = std::min(end, lane.ticks);
    if (lane.tail_begin_tick > tick_) end = std::min(end, lane.tail_begin_tick);
    end = std::min(
        end, lane.path.bends_within_tick() ? tick_ + 1 : lane.path.straight().straight_until_tick);
  }
  return end;
}

void LaneGroup::choose_parts() {
  parts_.moving = false;
  parts_.tail = false;
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& lane = lanes_[i];
    if (!lane.running) continue;
    if (!lane.in_tail && lane.tail_begin_tick == tick_) {
      begin_tail(i, block_.state);
      lane.in_tail = true;
    }
    parts_.moving = parts_.moving || lane.path.velocity_m_per_s() != 0.0;
    parts_.tail = parts_.tail || lane.in_tail;
  }
}

void LaneGroup::run_stretch(std::uint64_t end) {
  const bool bend = std::any_of(lanes_.begin(), lanes_.end(), [](const Lane& lane) {
    return lane.running && lane.path.bends_within_tick();
  });
  if (bend) before_bend_ = block_.state;
  const std::uint64_t reached = run_lanes(block_, parts_, tick_, end);
  if (bend && reached == end) bend_paths(before_bend_);
  tick_ = reached;
  leave_segments();
}

// Repeats the tick of the lanes whose path bends, because the loops treat every path as straight.
void LaneGroup::bend_paths(const LaneState& before) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& lane = lanes_[i];
    if (!lane.running || !lane.path.bends_within_tick()) continue;
    const double period_s = lane.scene->sampling.period_s();
    LanePlant plant(plants_.plant(plant_parameters(*lane.scene), period_s), lane.path, period_s,
                    lane.scene->x().device.start_m, 0.0);
    plant.path() = lane.path;
    advance_scalar(i, before, plant, block_.state);
    lane.path = plant.path();
    write_path(i);
  }
}

// Advances the paths whose straight segment ends at this tick.
void LaneGroup::leave_segments() {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& lane = lanes_[i];
    if (!lane.running || lane.path.bends_within_tick()) continue;
    StraightPath straight = lane.path.straight();
    if (straight.straight_until_tick != tick_ || straight.tick == tick_) continue;
    straight.tick = tick_ - 1;
    lane.path.resume(straight);
    lane.path.next_tick();
    write_path(i);
  }
}

void LaneGroup::write_path(std::size_t lane) {
  const StraightPath& path = lanes_[lane].path.straight();
  LaneParameters& parameters = block_.parameters;
  parameters.path_m[lane] = path.position_m;
  parameters.path_speed_m_per_s[lane] = path.velocity_m_per_s;
  parameters.segment_begin_tick[lane] = path.segment_begin_tick;
  parameters.segment_m[lane] = path.segment_position_m;
}

void LaneGroup::end_lanes(const OnEnd& on_end) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    if (!lanes_[i].running) continue;
    if (has_diverged(block_.state.motion.position_m[i])) {
      end_lane(i, on_end, tick_);
    } else if (tick_ == lanes_[i].ticks) {
      end_lane(i, on_end, std::nullopt);
    }
  }
}

void LaneGroup::end_lane(std::size_t lane, const OnEnd& on_end,
                         std::optional<std::uint64_t> diverged) {
  lanes_[lane].running = false;
  const bool has_tail = tick_ > lanes_[lane].tail_begin_tick;
  on_end({lane, tick_, diverged, has_tail}, block_);
  clear_lane(lane, block_);
}

}  // namespace hapticwall::batch
