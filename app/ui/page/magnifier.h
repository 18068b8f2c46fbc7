// The contact, magnified until single encoder counts are visible.
#pragma once

#include <optional>

#include "app/draw/plot/plot_labels.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/wall/wall_picture.h"
#include "app/ui/state/panel_context.h"
#include "app/ui/wall/wall_state.h"

namespace hapticwall::ui {

// Fills the current window. `view_pixels_per_m`: the scale of the wall view at the contact,
// to which the magnification refers.
void draw_magnifier(const PanelContext& context, const draw::SampleHistory& history,
                    double view_pixels_per_m);

// A contact that is shown magnified: of the session, or of a run beside it.
struct ContactView {
  const draw::WallPicture& picture;  // along its x axis
  const draw::SampleHistory& history;
  const Sample& newest;
  std::optional<double> encoder_m;
  bool measured = true;  // false: without encoder counts and measured position
};
// How far beyond the face the handle was in the last half second, m.
[[nodiscard]] double recent_depth_m(const ContactView& view, const Magnified& magnified);
// The width to show, m: the one that the user has chosen, or one that fits `deepest_m`.
// `unmagnified_m`: the width at ×1.
[[nodiscard]] double contact_span_m(WallState& state, double deepest_m, double unmagnified_m);
// Draws the contact into a box of the current window. `magnified` is kept between frames, one for
// each box; `trail` is overwritten.
void draw_contact(const draw::Theme& theme, const draw::PixelBox& box, double span_m,
                  const ContactView& view, Magnified& magnified, draw::Trace& trail);

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
