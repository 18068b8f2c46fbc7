// The panel on the left: scene, algorithm, wall, hand and loop, one function a section.
#pragma once

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

void draw_scene_section(const PanelContext& context);      // scene_panel.cpp
void draw_algorithm_section(const PanelContext& context);  // algorithm_panel.cpp
void draw_wall_section(const PanelContext& context);       // wall_panel.cpp
void draw_hand_section(const PanelContext& context);       // hand_panel.cpp
void draw_loop_section(const PanelContext& context);       // scene_panel.cpp

// Selects algorithms()[index], if there is one, with the parameters that are set.
void choose_algorithm(const PanelContext& context, std::size_t index);

}  // namespace hapticwall::ui
