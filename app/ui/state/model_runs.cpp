#include "app/ui/state/model_runs.h"

#include "app/session/replay_session.h"
#include "app/session/scene_change.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/scene_state.h"

namespace hapticwall::ui {

std::string why_no_runs(const PanelContext& context) {
  if (!context.session.device_info().is_simulated) {
    return "This page computes the simulator's model of handle and hand. The hand at a device has "
           "no model: start the program without the device.";
  }
  if (context.shows.replay != nullptr &&
      !context.shows.replay->recording().loaded.not_repeatable_because.empty()) {
    return "This page would run the script of the recording's scene, not the recorded hand. "
           "`hapticwall compare NAME.csv` and `map NAME.csv` re-run that hand.";
  }
  const auto& hand = context.session.scene().x().hand;
  if (hand && hand->follows_mouse) {
    return "The pointer leads the hand of this scene. This page needs a hand with a path of its "
           "own: choose another scene.";
  }
  return "";
}

bool scene_in_motion() {
  return ImGui::IsMouseDown(ImGuiMouseButton_Left) && ImGui::IsAnyItemActive();
}

void make_running(const PanelContext& context, const Scene& wanted) {
  if (context.shows.live == nullptr) return;
  if (session::needs_new_session(context.session.scene(), wanted)) {
    context.scene.wanted = WantedScene{wanted};
  } else if (const auto problem = ask_for(context, wanted)) {
    tell(context.toasts, *problem);
  }
}

}  // namespace hapticwall::ui
