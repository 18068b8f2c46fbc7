// The area below the views: page tabs, energy lamp and the page.
#pragma once

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// The shown page; during a blind test always that of the test.
[[nodiscard]] LowerPage lower_page(const PanelContext& context);

// Fills the rest of the window.
void draw_lower_page(const PanelContext& context, const draw::SampleHistory& history);

}  // namespace hapticwall::ui
