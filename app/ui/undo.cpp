#include "app/ui/undo.h"

#include <fmt/format.h>

#include <utility>

#include "app/runtime/scene_change.h"
#include "app/ui/parameter_rows.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

std::string difference(const Scene& from, const Scene& to) {
  if (from.name != to.name) return "scene " + to.name;
  std::vector<std::string> lines = changed_values(to, from);
  const auto list = algorithms();
  if (from.algorithm.index != to.algorithm.index && to.algorithm.index < list.size())
    lines.push_back(fmt::format("algorithm {}", list[to.algorithm.index].name));
  if (from.sampling.rate_hz != to.sampling.rate_hz)
    lines.push_back(
        fmt::format("sampling rate {} Hz", hapticwall::number_text(to.sampling.rate_hz)));
  if (lines.empty()) return "the hand's script";
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

bool same_scene(const Scene& a, const Scene& b) {
  return a.name == b.name && a.description == b.description && a.duration_s == b.duration_s &&
         a.sampling.rate_hz == b.sampling.rate_hz && a.device == b.device && a.hand == b.hand &&
         a.simulator == b.simulator && runtime::same_parameters(a, b);
}

void UndoHistory::observe(const Scene& scene, const Scene& loaded, bool dragging) {
  const std::optional<std::size_t> wanted = std::exchange(wanted_, std::nullopt);
  const bool was_within = std::exchange(within_drag_, within_drag_ && dragging);
  if (steps_.empty()) {
    steps_.push_back({scene, loaded});
    return;
  }
  if (same_scene(scene, steps_[present_].scene)) {
    steps_[present_].loaded = loaded;
    return;
  }
  if (wanted) {
    // A device may have made of it what it can do.
    present_ = *wanted;
    steps_[present_] = {scene, loaded};
    return;
  }
  if (was_within && dragging) {
    steps_[present_] = {scene, loaded};
    return;
  }
  add({scene, loaded});
  within_drag_ = dragging;
}

void UndoHistory::add(SceneStep step) {
  steps_.resize(present_ + 1);
  steps_.push_back(std::move(step));
  if (steps_.size() > kMostUndoSteps) steps_.erase(steps_.begin());
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
  return can_undo() ? difference(steps_[present_].scene, steps_[present_ - 1].scene) : "";
}

std::string UndoHistory::redo_text() const {
  return can_redo() ? difference(steps_[present_].scene, steps_[present_ + 1].scene) : "";
}

}  // namespace hapticwall::ui
