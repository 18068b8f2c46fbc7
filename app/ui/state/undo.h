// Undo and redo of everything that the user changes of a scene: whole scenes, side by side.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/compare_state.h"
#include "core/scene.h"

namespace hapticwall::ui {

// A scene, and the one that its values can be reset to. The scene's algorithm is that of the slot
// that was active; undo puts the one of the slot that is active into its place.
struct SceneStep {
  Scene scene;
  Scene loaded;
  CompareSlots slots;
};

// Everything of two scenes is the same.
[[nodiscard]] bool same_scene(const Scene& a, const Scene& b);

// Sees the running scene once a frame and makes a step of every change that it finds: no panel has
// to say what it does. All that changes within one drag of the pointer is one step.
class UndoHistory {
 public:
  // `dragging`: the pointer holds an item. The scene's algorithm is that of the active slot; which
  // one that is makes no step. Without slots there is one algorithm.
  void observe(const Scene& scene, const Scene& loaded, bool dragging, const CompareSlots& slots);
  void observe(const Scene& scene, const Scene& loaded, bool dragging) {
    observe(scene, loaded, dragging, {{}, {scene.algorithm, {}}});
  }

  // The step before or after the present one, or nothing. It is asked for, not done: the next
  // observe() finds out whether the session has taken it.
  [[nodiscard]] std::optional<SceneStep> undo();
  [[nodiscard]] std::optional<SceneStep> redo();

  [[nodiscard]] bool can_undo() const { return present_ > 0; }
  [[nodiscard]] bool can_redo() const { return present_ + 1 < steps_.size(); }
  // What undo or redo would change, a line for every value; empty where there is nothing.
  [[nodiscard]] std::string undo_text() const;
  [[nodiscard]] std::string redo_text() const;
  [[nodiscard]] std::size_t size() const { return steps_.size(); }

 private:
  [[nodiscard]] std::optional<SceneStep> want(std::size_t index);
  void add(SceneStep step);

  std::vector<SceneStep> steps_;
  std::size_t present_ = 0;
  std::optional<std::size_t> wanted_;
  bool within_drag_ = false;  // the present step is of a drag that still goes on
};

inline constexpr std::size_t kMostUndoSteps = 200;

}  // namespace hapticwall::ui
