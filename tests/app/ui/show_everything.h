#pragma once

#include "app/ui/panel/sections.h"
#include "app/ui/state/ui_state.h"

namespace hapticwall::test {

// What a newcomer opens with More, and without the tour.
inline void show_everything(ui::UiState& state) {
  ui::show_more(state.persisted);
  state.persisted.tour_offered = false;
}

}  // namespace hapticwall::test
