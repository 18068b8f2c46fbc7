// The tour above the views: the present step, whether it is seen, and frames around the places
// that it speaks of.
#pragma once

#include "app/ui/state/panel_context.h"
#include "app/ui/state/tour.h"

namespace hapticwall::ui {

// The offer, once; then the present step. Nothing during a replay and in a blind test.
void draw_tour_strip(const PanelContext& context);

// Begins at the first step, in the scene of the tour.
void begin_tour(const PanelContext& context);

// Each draws a frame around the last item if the present step points there.
void point_at(const PanelContext& context, TourPlace place);
void point_at_algorithm(const PanelContext& context, std::size_t algorithm);
void point_at_reset(const PanelContext& context);

}  // namespace hapticwall::ui
