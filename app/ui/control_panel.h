// The panel on the left: scene, algorithm, wall, hand, device and loop, one function a section.
#pragma once

#include <string>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_scene_section(const PanelContext& context);      // scene_panel.cpp
void draw_algorithm_section(const PanelContext& context);  // algorithm_panel.cpp
void draw_compare_section(const PanelContext& context);    // compare_panel.cpp
void draw_wall_section(const PanelContext& context);       // wall_panel.cpp
void draw_hand_section(const PanelContext& context);       // hand_panel.cpp
void draw_device_section(const PanelContext& context);     // device_panel.cpp
void draw_loop_section(const PanelContext& context);       // loop_panel.cpp

// What a tick costs: median and maximum of the last second; a dash where nothing is known yet.
[[nodiscard]] std::string cost_text(const runtime::TimingStatistics& timing);
// The hand's work less kinetic energy, losses and the actuator's work: what the integrator has
// lost.
[[nodiscard]] double energy_error_j(const PlantTruth& truth);

// Selects algorithms()[index], if there is one, with the parameters that are set. Of a replay:
// re-runs its hand under it.
void choose_algorithm(const PanelContext& context, std::size_t index);

}  // namespace hapticwall::ui
