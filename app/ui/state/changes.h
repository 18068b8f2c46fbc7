// Changes of the running scene: asked for by the panels, undone and redone.
#pragma once

#include <optional>

#include "app/ui/state/compare_state.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/scene_state.h"

namespace hapticwall::ui {

// Asks the live session for this scene, or for its own with this algorithm. A problem changes
// nothing. While a recording is shown nothing happens: a recording does not change.
[[nodiscard]] std::optional<SceneProblem> ask_for(const PanelContext& context, const Scene& wanted);
[[nodiscard]] std::optional<SceneProblem> ask_for_algorithm(const PanelContext& context,
                                                            const AlgorithmSettings& algorithm);

// Parts of the scene that were requested and that the loop has not echoed yet. A paused loop takes
// no parameters, so they stay in this list until the next tick.
struct AskedFor {
  bool algorithm = false;
  bool walls = false;
  bool hand = false;
  bool device = false;
  bool simulator = false;
  bool environment = false;
  bool estimator = false;
};
[[nodiscard]] AskedFor asked_for(const PanelContext& context);

// Requests the scene of the previous or the next step, with a new session if it needs one. Harmless
// without such a step.
void undo_change(const PanelContext& context);
void redo_change(const PanelContext& context);

// Call it after all panels of a frame, with the scene that now runs.
void notice_changes(SceneState& state, CompareState& compare, const Scene& scene);

}  // namespace hapticwall::ui
