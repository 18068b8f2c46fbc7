// The map page: where the present scene is stable, over two of its numbers.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

struct MapState;

void draw_map_page(const PanelContext& context, MapState& state);

}  // namespace hapticwall::ui
