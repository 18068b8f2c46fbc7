#include "app/runtime/parameter_history.h"

namespace hapticwall::runtime {

ParameterHistory::Adjustment::Adjustment(const Scene& scene)
    : device(scene.device),
      walls(scene.walls),
      algorithm(scene.algorithm),
      simulator(scene.simulator) {
  if (!scene.hand) return;
  hand = *scene.hand;
  hand->path = std::vector<PathPoint>();
}

ParameterHistory::ParameterHistory(const Scene& first) : newest_(first), at_start_(first) {
  published_.push_back({generation_, at_start_});
}

void ParameterHistory::add(const Scene& scene, bool unread) {
  newest_ = scene;
  if (unread && published_.size() > 1) published_.pop_back();
  published_.push_back({++generation_, Adjustment(scene)});
}

void ParameterHistory::came_into_force(const ParameterEcho& echo) {
  while (published_.size() > 1 && published_.front().generation != echo.generation) {
    published_.pop_front();
  }
  if (echo.tick == 0) {
    at_start_ = published_.front().adjustment;
    changes_.clear();
  } else {
    changes_.push_back({echo.tick, published_.front().adjustment});
  }
}

std::vector<file::RecordedChange> ParameterHistory::changes_before(std::uint64_t end_tick) const {
  std::vector<file::RecordedChange> changes;
  for (const Change& change : changes_) {
    if (change.tick < end_tick) changes.push_back({change.tick, scene_with(change.adjustment)});
  }
  return changes;
}

Scene ParameterHistory::scene_with(const Adjustment& adjustment) const {
  Scene scene = newest_;
  scene.device = adjustment.device;
  scene.walls = adjustment.walls;
  scene.algorithm = adjustment.algorithm;
  scene.simulator = adjustment.simulator;
  if (!adjustment.hand) return scene;
  scene.hand = adjustment.hand;
  scene.hand->path = newest_.hand->path;
  return scene;
}

}  // namespace hapticwall::runtime
