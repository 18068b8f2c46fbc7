// The shown axis of a scene with two axes: for plots, magnifier, readout and the wall's fields.
#pragma once

#include <vector>

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

// The shown axis as a scene of one axis.
[[nodiscard]] Scene shown_scene(const PanelContext& context);
[[nodiscard]] const std::vector<WallSettings>& shown_walls(const PanelContext& context);
[[nodiscard]] const Sample& shown_sample(const PanelContext& context);

// Asks for these walls on the shown axis. A problem changes nothing.
std::optional<SceneProblem> set_shown_walls(const PanelContext& context,
                                            const std::vector<WallSettings>& walls);

// Draws nothing for a scene with one axis. `name` distinguishes several choices.
void draw_axis_choice(const PanelContext& context, const char* name);

}  // namespace hapticwall::ui
