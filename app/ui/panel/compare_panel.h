// The two slots of the comparison.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_compare_section(const PanelContext& context);

}  // namespace hapticwall::ui
