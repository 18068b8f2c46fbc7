// What stands below the views: the strip with the choice of the page and the energy lamp, and the
// page.
#pragma once

#include "app/ui/sample_history.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// The page in force: while a blind test runs, that.
[[nodiscard]] LowerPage lower_page(const UiState& state);

// Draws both into the rest of the window.
void draw_lower_page(const PanelContext& context, const SampleHistory& history);

}  // namespace hapticwall::ui
