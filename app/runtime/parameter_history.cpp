#include "app/runtime/parameter_history.h"

namespace hapticwall::runtime {

namespace {

std::optional<HandSettings> without_path(std::optional<HandSettings> hand) {
  if (hand) hand->path = std::vector<PathPoint>();
  return hand;
}

// The hand of a change, on the path of the scene's.
std::optional<HandSettings> on_path(std::optional<HandSettings> hand,
                                    const std::optional<HandSettings>& whole) {
  if (hand && whole) hand->path = whole->path;
  return hand;
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
  if (adjustment.hand) scene.hand = on_path(adjustment.hand, newest_.hand);
  if (adjustment.y && newest_.y) {
    scene.y = adjustment.y;
    scene.y->hand = on_path(adjustment.y->hand, newest_.y->hand);
  }
  return scene;
}

}  // namespace hapticwall::runtime
