// The page of the blind test: set-up, trials, result.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_blind_test_page(const PanelContext& context);  // blind_test_page.cpp

void draw_blind_setup(const PanelContext& context);   // blind_test_page.cpp
void draw_blind_trial(const PanelContext& context);   // blind_trial.cpp
void draw_blind_result(const PanelContext& context);  // blind_result.cpp

}  // namespace hapticwall::ui
