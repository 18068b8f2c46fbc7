#include "app/ui/state/changes.h"

#include <algorithm>
#include <utility>

#include "app/session/scene_change.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/text_edit.h"

namespace hapticwall::ui {
namespace {

void go_to(const PanelContext& context, std::optional<SceneStep> step) {
  if (!step || context.shows.live == nullptr) return;
  context.edit.refusal.reset();
  const Scene& running = context.session.scene();
  step->scene.algorithm = step->slots.of(slots_of(context.compare).active);
  const bool other =
      running.name != step->scene.name || running.x().walls.size() != step->scene.x().walls.size();
  if (other || session::needs_new_session(running, step->scene)) {
    WantedScene wanted{std::move(step->scene)};
    wanted.back_to = std::make_shared<const Scene>(std::move(step->loaded));
    wanted.slots = step->slots.settings;
    context.scene.wanted = std::move(wanted);
    return;
  }
  if (const auto problem = context.shows.live->change_scene(step->scene)) {
    tell(context.toasts, *problem);
    return;
  }
  set_slots(context.compare, step->slots.settings);
  context.scene.loaded = std::move(step->loaded);
}

}  // namespace

std::optional<SceneProblem> ask_for(const PanelContext& context, const Scene& wanted) {
  if (context.shows.live == nullptr) return std::nullopt;
  return context.shows.live->change_scene(wanted);
}

std::optional<SceneProblem> ask_for_algorithm(const PanelContext& context,
                                              const AlgorithmSettings& algorithm) {
  Scene wanted = context.session.scene();
  wanted.algorithm = algorithm;
  return ask_for(context, wanted);
}

AskedFor asked_for(const PanelContext& context) {
  const Scene& asked = context.session.scene();
  const Scene& in_force = *context.shows.in_force;
  AskedFor differs;
  differs.algorithm = asked.algorithm != in_force.algorithm;
  differs.environment = asked.environment != in_force.environment;
  differs.estimator = asked.estimator != in_force.estimator;
  differs.simulator = asked.simulator != in_force.simulator || asked.sampling != in_force.sampling;
  for (std::size_t i = 0; i < std::min(asked.axes.size(), in_force.axes.size()); ++i) {
    differs.walls = differs.walls || asked.axes[i].walls != in_force.axes[i].walls;
    differs.hand = differs.hand || asked.axes[i].hand != in_force.axes[i].hand;
    differs.device = differs.device || asked.axes[i].device != in_force.axes[i].device;
  }
  return differs;
}

void undo_change(const PanelContext& context) { go_to(context, context.scene.undo.undo()); }

void redo_change(const PanelContext& context) { go_to(context, context.scene.undo.redo()); }

// A plug-in that was built again is no change that could be undone.
void notice_changes(SceneState& state, CompareState& compare, const Scene& present) {
  if (blind_test_runs(compare)) return;  // its walls are no changes of the user
  Scene scene = present;
  scene.algorithm.revision = 0;
  const bool dragging = ImGui::IsMouseDown(ImGuiMouseButton_Left) && ImGui::IsAnyItemActive();
  keep_slots(compare, scene);
  state.undo.observe(scene, state.loaded, dragging, slots_of(compare));
}

}  // namespace hapticwall::ui
