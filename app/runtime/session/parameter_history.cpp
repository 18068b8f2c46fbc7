#include "app/runtime/parameter_history.h"

#include <utility>

#include "app/file/sidecar.h"

namespace hapticwall::runtime {

namespace {

std::optional<HandSettings> without_path(std::optional<HandSettings> hand) {
  if (hand) hand->path = std::vector<PathPoint>();
  return hand;
}

// Takes all of a hand but its path.
void take_numbers(const HandSettings& from, std::optional<HandSettings>& to) {
  HandSettings taken = from;
  if (to) taken.path = std::move(to->path);
  to = std::move(taken);
}

}  // namespace

ParameterHistory::Adjustment::Adjustment(const Scene& scene)
    : device(scene.device),
      hand(without_path(scene.hand)),
      walls(scene.walls),
      y(scene.y),
      algorithm(scene.algorithm),
      simulator(scene.simulator) {
  if (y) y->hand = without_path(y->hand);
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
  ++revision_;
  if (echo.tick == 0) {
    at_start_ = published_.front().adjustment;
    changes_.clear();
    knows_start_ = true;
    lost_changes_ = false;
  } else if (changes_.size() < file::kMostChanges) {
    changes_.push_back({echo.tick, published_.front().adjustment});
  } else {
    lost_changes_ = true;
  }
}

std::vector<file::RecordedChange> ParameterHistory::changes_before(std::uint64_t end_tick) const {
  Scene without_paths = newest_;
  if (without_paths.hand) without_paths.hand->path.clear();
  if (without_paths.y && without_paths.y->hand) without_paths.y->hand->path.clear();
  std::vector<file::RecordedChange> changes;
  for (const Change& change : changes_) {
    if (change.tick >= end_tick) continue;
    changes.push_back({change.tick, scene_with(without_paths, change.adjustment)});
  }
  return changes;
}

// `scene`: the newest, for what may not change.
Scene ParameterHistory::scene_with(Scene scene, const Adjustment& adjustment) {
  scene.device = adjustment.device;
  scene.walls = adjustment.walls;
  scene.algorithm = adjustment.algorithm;
  scene.simulator = adjustment.simulator;
  if (adjustment.hand) take_numbers(*adjustment.hand, scene.hand);
  if (adjustment.y && scene.y) {
    std::optional<HandSettings> hand = std::move(scene.y->hand);
    scene.y = adjustment.y;
    if (adjustment.y->hand) {
      take_numbers(*adjustment.y->hand, hand);
      scene.y->hand = std::move(hand);
    }
  }
  return scene;
}

}  // namespace hapticwall::runtime
