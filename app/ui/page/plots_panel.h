// The live plots: their arrangement, the time window, and following the newest samples.
#pragma once

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_plots_panel(const PanelContext& context, const draw::SampleHistory& history);

// The other slot's newest contact, drawn over the present one. Call it once a frame, before the
// plots. Rebuilds the ghost only for a new contact or another slot.
void show_ghost(const PanelContext& context);

}  // namespace hapticwall::ui
