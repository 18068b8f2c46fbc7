// Converts between a DockLayout and the dock nodes of Dear ImGui. Call it between NewFrame() and
// Render().
#pragma once

#include <imgui.h>

#include <string>

#include "app/ui/state/dock_layout.h"

namespace hapticwall::ui {

// The title and the id of a dock window, for ImGui::Begin().
[[nodiscard]] std::string dock_window(const std::string& page);

// Makes the dock space `id` anew. Call it in the window of the dock space, before DockSpace().
void build_dock(ImGuiID id, const DockLayout& layout, ImVec2 size);
// Gives the nodes the sizes of `layout` in a dock space of this size, px. A node that is split
// otherwise keeps its sizes.
void fit_dock(ImGuiID id, const DockLayout& layout, ImVec2 size);
// The present arrangement of the windows that were begun in this frame.
[[nodiscard]] DockLayout read_dock(ImGuiID id);

// Moves and shrinks floating windows, so that they stay within the main window.
void keep_floating_inside();

// The arrow keys go from one docked window to the next. Share them while a frame is drawn, not
// between two frames: Dear ImGui cannot undock a window that shares them.
void share_arrows(bool shared);
// Call it before ImGui::Begin() of this page.
void prepare_docked(const std::string& page);
// The next child window shares the arrow keys with its parent.
void flatten_next();

}  // namespace hapticwall::ui
