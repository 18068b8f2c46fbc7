// The contact, magnified until single counts of the encoder are plain to see.
#pragma once

#include <array>

#include "app/ui/sample_history.h"
#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// How much larger than in the wall view, as that shows a scene at first.
inline constexpr std::array kMagnifications{10, 20, 50, 100, 200, 500, 1000};

// Fills the current child window. `view_pixels_per_m`: the scale of the wall view at the contact,
// to which the magnification refers.
void draw_magnifier(const PanelContext& context, const SampleHistory& history,
                    double view_pixels_per_m);

// The largest magnification at which `deepest_m` beyond the face is still shown, where
// `unmagnified_m` is what the magnifier would show at ×1. Shrinks at once, grows only when there is
// room to spare, so that it does not flicker; `current` 0: there is none yet.
[[nodiscard]] int suitable_magnification(double deepest_m, double unmagnified_m, int current);

// `steps` further in the list, up or down, within it.
[[nodiscard]] int next_magnification(int current, int steps);

// Where to look, `span_m` being shown: at the face, or, where the handle stays deeper than that
// shows, at the handle. `least_m` and `most_m`: where the handle has been of late.
[[nodiscard]] Magnified look_at_contact(const WallPicture& picture, double least_m, double most_m,
                                        double span_m, const Magnified& before);

}  // namespace hapticwall::ui
