#pragma once

#include "app/ui/panel/sections.h"
#include "app/ui/window/ui_state.h"

namespace hapticwall::test {

// The layout 'bench' with the pages that the list of windows opens.
inline constexpr const char* kEveryPage =
    "X21.5em(Controls;Y40%(X62%(Wall;Contact);Plots*,Timing,Blind test,Map,All at "
    "once,Study,Identify))";

// Shows everything that More and the switches in it open for a newcomer, without the tour. The time
// axes have the chosen length.
inline void show_everything(ui::UiState& state) {
  ui::show_more(state.window, state.plots);
  state.window.status_shown = true;
  if (state.dock.docked.empty()) state.dock.docked = kEveryPage;
  state.compare.persisted.open = true;
  state.plots.persisted.show_counts = true;
  state.time.follows_rhythm = false;
  state.tour.offered = false;
}

}  // namespace hapticwall::test
