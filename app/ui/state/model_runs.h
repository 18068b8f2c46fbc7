// Runs of the simulator's model beside the session: which scene they are of, and how one of them
// becomes the session.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Why the model of this session cannot run by itself; "" if it can.
[[nodiscard]] std::string why_no_runs(const PanelContext& context);

// The user moves a slider: the scene changes from frame to frame.
[[nodiscard]] bool scene_in_motion();

// Requests this scene, with a new session if it needs one. No effect while a recording is shown.
void make_running(const PanelContext& context, const Scene& wanted);

}  // namespace hapticwall::ui
