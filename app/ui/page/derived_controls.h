// The popup that adds and removes derived signals.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_derived_signals(const PanelContext& context);

}  // namespace hapticwall::ui
