// State of the dock: its windows and their arrangement.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/state/dock_layout.h"

namespace hapticwall::ui {

// A window that can be docked.
struct DockWindow {
  const char* name;
  const char* meaning;
};

// An arrangement of windows that the user has named.
struct OwnLayout {
  std::string name;
  DockLayout layout;

  [[nodiscard]] bool operator==(const OwnLayout&) const = default;
};

enum class DockSituation : std::uint8_t { kNone, kFirstMinute, kBlindTest, kChosen };

struct DockState {
  // Stored in the settings file.
  std::string layout = "bench";
  std::string docked;  // layout_text() of the windows as they are; empty: as the layout has them
  std::vector<OwnLayout> own_layouts;

  // Lives as long as the window.
  std::vector<DockWindow> windows;   // all of them, for the choice
  std::optional<DockLayout> chosen;  // as the user has arranged it; nullopt at the start
  DockLayout shown;                  // `chosen`, or that of the first minute or of a blind test
  DockLayout measured;               // as read after the sizes of `shown` were set
  DockSituation situation = DockSituation::kNone;
  bool rebuild = true;
  int settling = 0;  // frames until all sizes are known
  ImVec2 size;       // px
  float scale = 0.0F;
};

// Shows the page from the next frame on. During a blind test only its own windows are shown. The
// page gets the focus. Otherwise a new window would take the focus from a window that closes, and
// would come to the front.
inline void show_page(DockState& dock, const char* page) {
  ImGui::SetWindowFocus((std::string("###page ") + page).c_str());
  if (dock.chosen) bring_to_front(*dock.chosen, page);
  dock.rebuild = true;
}

}  // namespace hapticwall::ui
