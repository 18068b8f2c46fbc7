// The live plots: their arrangement, the time window, and following the newest samples.
#pragma once

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_plots_panel(const PanelContext& context, const draw::SampleHistory& history);

// Sets the time axes to the newest `time_window_s`. A younger session begins at the left.
void follow_newest(UiState& state, double newest_time_s);

}  // namespace hapticwall::ui
