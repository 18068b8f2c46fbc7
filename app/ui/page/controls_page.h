// The panel with the parameters.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_controls_page(const PanelContext& context);

}  // namespace hapticwall::ui
