// Colours and scale. A choice takes effect at the next frame.
#pragma once

#include <optional>

#include "app/draw/plot/theme.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

struct Appearance {
  // Stored in the settings file.
  draw::Look look = draw::Look::kScreen;
  int scale_percent = 0;  // 0: follow the screen

  // Lives as long as the window.
  float screen_scale = 1.0F;          // scale of the screen
  std::optional<float> forced_scale;  // from the command line, until the user chooses another
};

// Scale of everything, relative to the designed size; and the same in %.
[[nodiscard]] float scale_in_force(const Appearance& appearance);
[[nodiscard]] int scale_percent_in_force(const Appearance& appearance);

// 0 follows the screen; any other value is clamped to the allowed range.
void set_scale(Appearance& appearance, int percent);
// One step larger (1) or smaller (-1).
void step_scale(Appearance& appearance, int steps);

void toggle_look(const PanelContext& context);

}  // namespace hapticwall::ui
