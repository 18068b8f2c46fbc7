// The page of all algorithms: the present scene under each, side by side.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

class AllRuns;

void draw_all_page(const PanelContext& context, AllRuns& all);

}  // namespace hapticwall::ui
