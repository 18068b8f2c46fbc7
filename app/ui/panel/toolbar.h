// The top row: pause, step, reset, time, and the recording.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_toolbar(const PanelContext& context);

// Actions of the buttons and keys.
void toggle_pause(const PanelContext& context);
// One step in the list of slow motions; no effect on a real device and in a replay.
void change_slow_motion(const PanelContext& context, int steps);
void single_step(const PanelContext& context);
// While a recording runs, asks first; the second time it agrees.
void ask_to_reset(const PanelContext& context);
void reset_session(const PanelContext& context);
void toggle_recording(const PanelContext& context);
// False, with a message, if nothing is being recorded.
[[nodiscard]] bool add_mark(const PanelContext& context);
// add_mark(); then the keyboard names the mark.
void mark_and_name(const PanelContext& context);
void stop_recording(Toasts& toasts, session::LiveSession& live);

// An unused path for a recording of this name in `folder`. Adds ".csv" where it is missing, and
// "-2", "-3" … where needed.
[[nodiscard]] std::string unused_recording_path(const std::string& folder, const std::string& name);

}  // namespace hapticwall::ui
