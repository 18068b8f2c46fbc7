// The strip above everything that says whether a real device pushes; a simulator has none.
#pragma once

#include <string>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// What the strip says, in one line: "FORCE OFF: the handle is inside the wall: move it out first".
[[nodiscard]] std::string arming_text(const runtime::Snapshot& snapshot);

void draw_arming_strip(const PanelContext& context);

// What the button and the keys A and Space do; nothing on a simulator.
void ask_to_arm(const PanelContext& context);
void disarm(const PanelContext& context);

}  // namespace hapticwall::ui
