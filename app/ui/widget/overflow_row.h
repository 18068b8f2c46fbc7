// A row of controls. Those that do not fit stand in a popup behind "…" at its right end.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

struct RowControl {
  float width = 0.0F;  // width in the row, px, constant for every content
  int rank = 0;        // the smallest stays longest
  std::function<void()> draw;
  std::string refusal = {};     // key of the line below its field, see refuse()
  bool takes_keyboard = false;  // opens the popup if the control is in it
};

// Draws the controls from left to right, each at a place that depends on widths alone. The popup
// has one control in a row. `room`: of the row, in pixels; 0: all that is left. `small`: a row of
// text and small buttons.
struct RowLook {
  float room = 0.0F;
  bool small = false;
};
void draw_overflow_row(const PanelContext& context, const char* name,
                       std::span<const RowControl> controls, const RowLook& look = {});

// Controls that stay in a row of this width: by rank, while they fit. `gap`: between two of them.
// `more`: width of the button that opens the popup. Pixels.
[[nodiscard]] std::vector<bool> controls_in_row(std::span<const RowControl> controls, float width,
                                                float gap, float more);

}  // namespace hapticwall::ui
