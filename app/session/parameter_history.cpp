#include "app/session/parameter_history.h"

#include <utility>

#include "app/file/recording/sidecar.h"

namespace hapticwall::session {

ParameterHistory::Adjustment::Adjustment(const Scene& scene)
    : axes(without_paths(scene).axes),
      environment(scene.environment),
      algorithm(scene.algorithm),
      estimator(scene.estimator),
      simulator(scene.simulator) {}

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
  ++revision_;
  if (echo.tick == 0) {
    at_start_ = published_.front().adjustment;
    changes_.clear();
    knows_start_ = true;
    lost_changes_ = false;
  } else if (changes_.size() < file::kMaxChanges) {
    changes_.push_back({echo.tick, published_.front().adjustment});
  } else {
    lost_changes_ = true;
  }
}

std::vector<ScheduledChange> ParameterHistory::changes_before(std::uint64_t end_tick) const {
  const Scene newest = without_paths(newest_);
  std::vector<ScheduledChange> changes;
  for (const Change& change : changes_) {
    if (change.tick >= end_tick) continue;
    changes.push_back({change.tick, scene_with(newest, change.adjustment)});
  }
  return changes;
}

// `scene`: the newest one, for values that may not change.
Scene ParameterHistory::scene_with(Scene scene, const Adjustment& adjustment) {
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    AxisSettings axis = adjustment.axes[i];
    if (axis.hand) axis.hand->path = std::move(scene.axes[i].hand->path);
    scene.axes[i] = std::move(axis);
  }
  scene.environment = adjustment.environment;
  scene.algorithm = adjustment.algorithm;
  scene.estimator = adjustment.estimator;
  scene.simulator = adjustment.simulator;
  return scene;
}

}  // namespace hapticwall::session
