// The row on top: pause, step, reset, time, and the recording.
#pragma once

#include <string>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_toolbar(const PanelContext& context);

// A button that tests and the help find by `name`; true when it is pressed.
[[nodiscard]] bool named_button(const PanelContext& context, const char* label, const char* name,
                                float width_ems, const char* tooltip);

// What the buttons and keys do.
void toggle_pause(const PanelContext& context);
void single_step(const PanelContext& context);
void reset_session(const PanelContext& context);
void toggle_recording(const PanelContext& context);
void add_mark(const PanelContext& context);

// A path in `folder` for a recording of this name (".csv" is added where it lacks), which no file
// has yet: "-2", "-3" … are appended.
[[nodiscard]] std::string unused_recording_path(const std::string& folder, const std::string& name);

}  // namespace hapticwall::ui
