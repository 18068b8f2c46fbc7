// The tour above the views: the present step, and whether it is done.
#pragma once

#include <cstddef>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

struct TourState {
  bool offered = true;   // stored in the settings file
  std::size_t step = 0;  // from 1; 0: no tour
  bool step_done = false;
};

// The offer, once; then the present step. Nothing during a replay and in a blind test.
void draw_tour_strip(const PanelContext& context);

// Begins at the first step, in the scene of the tour.
void begin_tour(const PanelContext& context);

}  // namespace hapticwall::ui
