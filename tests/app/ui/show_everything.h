#pragma once

#include "app/ui/panel/sections.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::test {

// Shows everything that More opens for a newcomer, without the tour.
inline void show_everything(ui::UiState& state) {
  ui::show_more(state.persisted);
  state.persisted.tour_offered = false;
}

}  // namespace hapticwall::test
