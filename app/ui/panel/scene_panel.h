// The scene, and the way back to its values.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_scene_section(const PanelContext& context);

}  // namespace hapticwall::ui
