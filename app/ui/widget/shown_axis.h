// The shown axis of a scene with two axes: for plots, magnifier, readout and the wall's fields.
#pragma once

#include <optional>
#include <vector>

#include "app/ui/state/panel_context.h"
#include "core/study/stability_bounds.h"

namespace hapticwall::ui {

// The axis and the wall whose values the panels show.
struct Selection {
  Axis axis = Axis::kX;
  std::size_t wall = 0;
};

[[nodiscard]] std::size_t shown_index(const PanelContext& context);
// The shown axis as a scene of one axis.
[[nodiscard]] Scene shown_scene(const PanelContext& context);
[[nodiscard]] const std::vector<WallSettings>& shown_walls(const PanelContext& context);
[[nodiscard]] const DeviceSettings& shown_device(const PanelContext& context);
[[nodiscard]] const Sample& shown_sample(const PanelContext& context);

// Delay of a simulated device as the scene states it, of a real one as measured; nullopt: unknown.
[[nodiscard]] std::optional<LoopDelay> shown_delay(const PanelContext& context);
// Bounds of one of the shown walls. The hand at a real device is not that of the scene, so these
// are without a hand. Without a known delay, there is no bound that depends on it.
[[nodiscard]] StabilityBounds shown_bounds(const PanelContext& context, const WallSettings& wall);

// Asks for these walls on the shown axis. A problem changes nothing.
std::optional<SceneProblem> set_shown_walls(const PanelContext& context,
                                            const std::vector<WallSettings>& walls);

// Draws nothing for a scene with one axis. `name` distinguishes several choices.
void draw_axis_choice(const PanelContext& context, const char* name);

}  // namespace hapticwall::ui
