// Named arrangements of the windows, and the list that chooses one.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/ui/state/dock_state.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/state/plots_state.h"

namespace hapticwall::ui {

inline constexpr const char* kUsualLayout = "bench";
inline constexpr std::size_t kMaxLayoutNameBytes = 40;
inline constexpr std::size_t kMaxOwnLayouts = 20;
// Layout of the first minute, which has no name.
inline constexpr const char* kFirstMinute = "X21.5em(Controls;Y40%(Wall;Plots))";

struct BuiltinLayout {
  const char* name;
  const char* meaning;
  const char* text;  // input of parse_layout()
  std::optional<PlotArrangement> arrangement;
  Needs needs = nullptr;
};
[[nodiscard]] std::span<const BuiltinLayout> builtin_layouts();

// Restores the arrangement of the settings file at the start. If that names a layout that is gone,
// a message says so, and the usual one is shown.
void restore_layout(DockState& dock, Toasts& toasts);
// Shows the windows as the layout of this name has them. Precondition: there is one.
void choose_layout(DockState& dock, WindowState& window, PlotsState& plots,
                   const std::string& name);
// The next one of the list.
void choose_next_layout(const PanelContext& context);

// Keeps the present arrangement under a name; replaces one of that name. Returns what is wrong with
// the name, or nullopt.
[[nodiscard]] std::optional<std::string> keep_layout(DockState& dock, const std::string& name);
// The windows stay where they are.
void forget_layout(DockState& dock, const std::string& name);

// A list: layouts, "keep as", and which windows are open. Nothing during a blind test.
void draw_layout_choice(const PanelContext& context);

}  // namespace hapticwall::ui
