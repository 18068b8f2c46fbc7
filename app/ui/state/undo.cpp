#include "app/ui/state/undo.h"

#include <fmt/format.h>

#include <utility>

#include "app/session/scene_change.h"
#include "app/ui/state/changed_values.h"
#include "core/algorithm/algorithm.h"
#include "core/scene_keys.h"

namespace hapticwall::ui {
namespace {

// Toggling the slots does not change their contents.
bool same_step(const SceneStep& step, const Scene& scene, const CompareSlots& slots) {
  if (step.slots.settings != slots.settings) return false;
  if (step.slots.active == slots.active) return same_scene(step.scene, scene);
  Scene with_its_slot = scene;
  with_its_slot.algorithm = step.scene.algorithm;
  return same_scene(step.scene, with_its_slot);
}

std::string difference(const SceneStep& from_step, const SceneStep& to_step) {
  const Scene& from = from_step.scene;
  Scene to = to_step.scene;
  if (from.name != to.name) return "scene " + to.name;
  const compare::Slot active = from_step.slots.active;
  const compare::Slot passive = compare::other(active);
  to.algorithm = to_step.slots.of(active);
  std::vector<std::string> lines = changed_values(to, from);
  if (from_step.slots.of(passive) != to_step.slots.of(passive)) {
    lines.push_back(fmt::format("slot {}: {}", compare::slot_name(passive),
                                compare::describe(to_step.slots.of(passive))));
  }
  const auto list = algorithms();
  if (from.algorithm.index != to.algorithm.index && to.algorithm.index < list.size())
    lines.push_back(fmt::format("algorithm {}", list[to.algorithm.index].name));
  if (from.sampling.rate_hz != to.sampling.rate_hz)
    lines.push_back(fmt::format("sampling rate {} Hz", number_text(to.sampling.rate_hz)));
  if (from.sampling.jitter != to.sampling.jitter)
    lines.push_back(fmt::format("jitter {}", shown_value(to.sampling.jitter)));
  if (from.sampling.seed != to.sampling.seed)
    lines.push_back(fmt::format("seed {}", shown_value(to.sampling.seed)));
  if (lines.empty()) return "the hand's script";
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

bool same_scene(const Scene& a, const Scene& b) {
  return a.name == b.name && a.description == b.description && a.duration_s == b.duration_s &&
         a.sampling == b.sampling && a.x().device == b.x().device && a.x().hand == b.x().hand &&
         a.simulator == b.simulator && session::same_parameters(a, b);
}

void UndoHistory::observe(const Scene& scene, const Scene& loaded, bool dragging,
                          const CompareSlots& slots) {
  const std::optional<std::size_t> wanted = std::exchange(wanted_, std::nullopt);
  const bool was_within = std::exchange(within_drag_, within_drag_ && dragging);
  if (steps_.empty()) {
    steps_.push_back({scene, loaded, slots});
    return;
  }
  if (same_step(steps_[present_], scene, slots)) {
    steps_[present_].scene.algorithm = scene.algorithm;
    steps_[present_].slots.active = slots.active;
    steps_[present_].loaded = loaded;
    return;
  }
  if (wanted) {
    // A device may have limited the values.
    present_ = *wanted;
    steps_[present_] = {scene, loaded, slots};
    return;
  }
  if (was_within && dragging) {
    steps_[present_] = {scene, loaded, slots};
    return;
  }
  add({scene, loaded, slots});
  within_drag_ = dragging;
}

void UndoHistory::add(SceneStep step) {
  steps_.resize(present_ + 1);
  steps_.push_back(std::move(step));
  if (steps_.size() > kMaxUndoSteps) steps_.erase(steps_.begin());
  present_ = steps_.size() - 1;
}

std::optional<SceneStep> UndoHistory::want(std::size_t index) {
  wanted_ = index;
  within_drag_ = false;
  return steps_[index];
}

std::optional<SceneStep> UndoHistory::undo() {
  return can_undo() ? want(present_ - 1) : std::nullopt;
}

std::optional<SceneStep> UndoHistory::redo() {
  return can_redo() ? want(present_ + 1) : std::nullopt;
}

std::string UndoHistory::undo_text() const {
  return can_undo() ? difference(steps_[present_], steps_[present_ - 1]) : "";
}

std::string UndoHistory::redo_text() const {
  return can_redo() ? difference(steps_[present_], steps_[present_ + 1]) : "";
}

}  // namespace hapticwall::ui
