// The row above the plots: which of them, which time, the scope, the cursors, and the exports.
#pragma once

#include <span>
#include <vector>

#include "app/ui/keys.h"
#include "app/ui/plot_bounds.h"
#include "app/ui/sample_history.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_plot_controls(const PanelContext& context, const SampleHistory& history);

// F follows or freezes, T takes the next kind of trigger, C shows or hides the cursors.
[[nodiscard]] std::vector<KeyBinding> plot_keys();

[[nodiscard]] std::span<const PlotId> plots_of(PlotArrangement arrangement);

// Of the chosen wall, as the wall's panel tells them.
[[nodiscard]] std::vector<BoundLine> bounds_of(const PanelContext& context);

// Writes what is seen into the recording folder, under a name that nothing has, and says so.
void export_samples(const PanelContext& context, const SampleHistory& history);
void export_figure(const PanelContext& context, const SampleHistory& history);

// Tells what became of an export of samples once it is done.
void notice_exported(const PanelContext& context);

}  // namespace hapticwall::ui
