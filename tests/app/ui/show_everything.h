#pragma once

#include "app/ui/panel/sections.h"
#include "app/ui/window/ui_state.h"

namespace hapticwall::test {

// Shows everything that More opens for a newcomer, without the tour.
inline void show_everything(ui::UiState& state) {
  ui::show_more(state.window, state.plots);
  state.tour.offered = false;
}

}  // namespace hapticwall::test
