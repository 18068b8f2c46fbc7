// The strip at the top shows whether a real device exerts force. A simulator has none.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Text of the strip: "FORCE OFF: the handle is inside the wall: move it out first".
[[nodiscard]] std::string arming_text(const session::Snapshot& snapshot);

void draw_arming_strip(const PanelContext& context);

// Actions of the button and of the keys A and Space. No effect on a simulator.
void ask_to_arm(const PanelContext& context);
void disarm(const PanelContext& context);

}  // namespace hapticwall::ui
