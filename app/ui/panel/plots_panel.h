// The live plots: their arrangement, the time window, and following the newest samples.
#pragma once

#include "app/ui/sample_history.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_plots_panel(const PanelContext& context, const SampleHistory& history);

// Sets the time axes to the newest `time_window_s`; a session younger than that begins at the left.
void follow_newest(UiState& state, double newest_time_s);

}  // namespace hapticwall::ui
