// The contact, magnified until a tenth of a millimetre is plain to see.
#pragma once

#include "app/ui/sample_history.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// Fills the current child window. `view_pixels_per_m`: the scale of the wall view at the contact,
// to which the magnification that is written refers.
void draw_magnifier(const PanelContext& context, const SampleHistory& history,
                    double view_pixels_per_m);

// How many metres the strip should show, where the deepest penetration of late was `deepest_m`:
// grows at once, shrinks only when there is room to spare, so that it does not flicker.
[[nodiscard]] double magnifier_span(double deepest_m, double current_span_m);

}  // namespace hapticwall::ui
