// Of a scene with two axes: the one that plots, magnifier, readout and the fields of the wall are
// of.
#pragma once

#include <vector>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

[[nodiscard]] bool shows_second_axis(const PanelContext& context);

// The shown axis as a scene of one axis.
[[nodiscard]] Scene shown_scene(const PanelContext& context);
[[nodiscard]] const std::vector<WallSettings>& shown_walls(const PanelContext& context);
[[nodiscard]] const Sample& shown_sample(const PanelContext& context);

// Puts these walls in force on the shown axis; a problem leaves everything as it was.
std::optional<SceneProblem> set_shown_walls(const PanelContext& context,
                                            const std::vector<WallSettings>& walls);

// Nothing where there is one axis. `name` tells this choice from another one.
void draw_axis_choice(const PanelContext& context, const char* name);

}  // namespace hapticwall::ui
