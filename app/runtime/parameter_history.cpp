#include "app/runtime/parameter_history.h"

namespace hapticwall::runtime {

ParameterHistory::ParameterHistory(const Scene& first)
    : newest_(first), at_start_{first.algorithm, first.walls} {
  published_.push_back({generation_, at_start_});
}

void ParameterHistory::add(const Scene& scene) {
  newest_ = scene;
  published_.push_back({++generation_, {scene.algorithm, scene.walls}});
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
  scene.algorithm = adjustment.algorithm;
  scene.walls = adjustment.walls;
  return scene;
}

}  // namespace hapticwall::runtime
