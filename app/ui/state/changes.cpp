#include "app/ui/undo_controls.h"

#include <utility>

#include "app/runtime/scene_change.h"
#include "app/ui/comparing.h"
#include "app/ui/replay_state.h"

namespace hapticwall::ui {
namespace {

void go_to(const PanelContext& context, std::optional<SceneStep> step) {
  if (!step || replay_of(context.session) != nullptr) return;
  TransientState& transient = context.state.transient;
  transient.refusal.reset();
  const Scene& running = context.session.scene();
  step->scene.algorithm = step->slots.of(slots_of(context.state).active);
  const bool other =
      running.name != step->scene.name || running.walls.size() != step->scene.walls.size();
  if (other || runtime::needs_new_session(running, step->scene)) {
    WantedScene wanted{std::move(step->scene)};
    wanted.back_to = std::make_shared<const Scene>(std::move(step->loaded));
    wanted.slots = step->slots.settings;
    transient.wanted_scene = std::move(wanted);
    return;
  }
  if (const auto problem = context.session.change_scene(step->scene)) {
    tell(context.state, *problem);
    return;
  }
  set_slots(context.state, step->slots.settings);
  transient.loaded_scene = std::move(step->loaded);
}

}  // namespace

void undo_change(const PanelContext& context) {
  go_to(context, context.state.transient.undo.undo());
}

void redo_change(const PanelContext& context) {
  go_to(context, context.state.transient.undo.redo());
}

void notice_changes(UiState& state, const Scene& scene) {
  const bool dragging = ImGui::IsMouseDown(ImGuiMouseButton_Left) && ImGui::IsAnyItemActive();
  keep_slots(state, scene);
  state.transient.undo.observe(scene, state.transient.loaded_scene, dragging, slots_of(state));
}

}  // namespace hapticwall::ui
