// The contact, magnified until single encoder counts are visible.
#pragma once

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/wall/wall_state.h"

namespace hapticwall::ui {

// Fills the current window. `view_pixels_per_m`: the scale of the wall view at the contact,
// to which the magnification refers.
void draw_magnifier(const PanelContext& context, const draw::SampleHistory& history,
                    double view_pixels_per_m);

// The largest magnification that still shows `deepest_m` beyond the face; `unmagnified_m` is the
// width at ×1. Shrinks at once and grows only with a reserve, so that it does not flicker.
// `current`: 0 at first.
[[nodiscard]] int suitable_magnification(double deepest_m, double unmagnified_m, int current);

// Moves `steps` in the list, clamped to its ends.
[[nodiscard]] int next_magnification(int current, int steps);

// Chooses the view of width `span_m`: at the face, or at the handle when it stays deeper.
// `least_m`, `most_m`: recent range of the handle.
[[nodiscard]] Magnified look_at_contact(const WallPicture& picture, double least_m, double most_m,
                                        double span_m, const Magnified& before);

}  // namespace hapticwall::ui
