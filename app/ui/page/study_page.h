// The study page: tables of the present scene, computed on demand.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

struct Studies;

void draw_study_page(const PanelContext& context, Studies& studies);

}  // namespace hapticwall::ui
