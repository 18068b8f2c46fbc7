// The parts of the control panel and of the status rows that only the window uses.
#pragma once

#include <string_view>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// The head: undo, redo, settings and help.
void draw_panel_head(const PanelContext& context);
void toggle_help(const PanelContext& context);
// Every section, page and control, and all plots.
void show_more(WindowState& window, PlotsState& plots);
// The window as it opens.
void show_less(WindowState& window);

void draw_scene_section(const PanelContext& context);
// Requests a built-in scene, with its own algorithm or the named one.
void want_builtin(const PanelContext& context, std::string_view name, std::string_view algorithm);
void draw_algorithm_section(const PanelContext& context);
void draw_compare_section(const PanelContext& context);
void draw_wall_section(const PanelContext& context);  // Section for the walls of the shown axis.
void draw_hand_section(const PanelContext& context);
void draw_device_section(const PanelContext& context);

// Selects algorithms()[index], if there is one, with the parameters that are set. While a recording
// is shown it re-runs the recorded hand under that algorithm.
void choose_algorithm(const PanelContext& context, std::size_t index);

// The row at the bottom: a hint while it is of use, and a dot that opens the state of the loop. The
// dot has a sentence beside it when something is wrong.
void draw_foot(const PanelContext& context);
void toggle_status(const PanelContext& context);

}  // namespace hapticwall::ui
