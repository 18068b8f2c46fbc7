// Undo history of scenes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/state/compare_state.h"
#include "core/scene.h"

namespace hapticwall::ui {

// A scene, and the scene to which its values can be reset. The algorithm is that of the slot that
// was active; undo replaces it by that of the slot that is active.
struct SceneStep {
  Scene scene;
  Scene loaded;
  CompareSlots slots;
};

// All fields of the two scenes are equal.
[[nodiscard]] bool same_scene(const Scene& a, const Scene& b);

// Compares the running scene once a frame and records every change as a step, so that no panel has
// to report one. All changes of one drag are one step.
class UndoHistory {
 public:
  // `dragging`: the pointer holds an item. The scene's algorithm is that of the active slot; a
  // change of the active slot is no step. Without slots there is one algorithm.
  void observe(const Scene& scene, const Scene& loaded, bool dragging, const CompareSlots& slots);
  void observe(const Scene& scene, const Scene& loaded, bool dragging) {
    observe(scene, loaded, dragging, {{}, {scene.algorithm, {}}});
  }

  // The previous or the next step, or nullopt. The caller asks the session for it; the next
  // observe() finds out whether the session has accepted it.
  [[nodiscard]] std::optional<SceneStep> undo();
  [[nodiscard]] std::optional<SceneStep> redo();

  [[nodiscard]] bool can_undo() const { return present_ > 0; }
  [[nodiscard]] bool can_redo() const { return present_ + 1 < steps_.size(); }
  // One line for every value that undo or redo would change; empty when there is no step.
  [[nodiscard]] std::string undo_text() const;
  [[nodiscard]] std::string redo_text() const;
  [[nodiscard]] std::size_t size() const { return steps_.size(); }

 private:
  [[nodiscard]] std::optional<SceneStep> want(std::size_t index);
  void add(SceneStep step);

  std::vector<SceneStep> steps_;
  std::size_t present_ = 0;
  std::optional<std::size_t> wanted_;
  bool within_drag_ = false;  // the present step belongs to a drag in progress
};

inline constexpr std::size_t kMaxUndoSteps = 200;

}  // namespace hapticwall::ui
