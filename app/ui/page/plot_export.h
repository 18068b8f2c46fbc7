// The two export buttons of the plots.
#pragma once

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// Writes the visible range into the recording folder, under an unused name, and tells the user.
void export_samples(const PanelContext& context, const draw::SampleHistory& history);
void export_figure(const PanelContext& context, const draw::SampleHistory& history);

// Tells the user once an export of samples is done.
void notice_exported(const PanelContext& context);

}  // namespace hapticwall::ui
