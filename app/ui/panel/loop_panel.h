// Rate, integrator and estimator of velocity, with their cost, error and delay.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

void draw_loop_section(const PanelContext& context);

// Cost of a tick: median and maximum of the last second, or a dash while they are unknown.
[[nodiscard]] std::string cost_text(const session::TimingStatistics& timing);
// Energy that the integrator has lost: the hand's work less kinetic energy, dissipation and the
// actuator's work.
[[nodiscard]] double energy_error_j(const PlantTruth& truth);

}  // namespace hapticwall::ui
