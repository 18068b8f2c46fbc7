// The choice of the algorithm, and its parameters as it declares them.
#pragma once

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

void draw_algorithm_section(const PanelContext& context);

// Selects algorithms()[index], if there is one, with the parameters that are set. While a recording
// is shown it re-runs the recorded hand under that algorithm.
void choose_algorithm(const PanelContext& context, std::size_t index);

}  // namespace hapticwall::ui
