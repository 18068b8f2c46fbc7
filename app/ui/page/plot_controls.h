// The row above the plots: arrangement, time window, trigger, cursors and exports.
#pragma once

#include <span>
#include <vector>

#include "app/draw/plot/plot_bounds.h"
#include "app/draw/plot/sample_history.h"
#include "app/ui/state/key_binding.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/plots_state.h"

namespace hapticwall::ui {

void draw_plot_controls(const PanelContext& context, const draw::SampleHistory& history);

// F toggles following, T selects the next trigger mode, C toggles the cursors.
[[nodiscard]] std::vector<KeyBinding> plot_keys();

[[nodiscard]] std::span<const draw::PlotId> plots_of(PlotArrangement arrangement);

// plot_export.cpp

// Writes the visible range into the recording folder, under an unused name, and tells the user.
void export_samples(const PanelContext& context, const draw::SampleHistory& history);
void export_figure(const PanelContext& context, const draw::SampleHistory& history);
// Tells the user once an export of samples is done.
void notice_exported(const PanelContext& context);

// Stability bounds of the chosen wall, as in the wall panel.
[[nodiscard]] std::vector<draw::BoundLine> bounds_of(const PanelContext& context);

}  // namespace hapticwall::ui
