// Numbers of wide range: a field that is typed into, and below it a thin slider, as far from 1 to
// 10 as from 10 to 100.
#pragma once

#include <optional>
#include <string_view>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// Of the slider; what lies beyond it can be typed.
struct LogRange {
  double minimum = 1.0;  // more than 0
  double maximum = 10.0;
  bool zero_at_left = false;  // the left end stands for 0
};

// Where a slider stands, 0 to 1, and back: with three digits, for it cannot tell more apart.
[[nodiscard]] double slider_share(double value, const LogRange& range);
[[nodiscard]] double slider_value(double share, const LogRange& range);

// A decade and a half to either side of a usual value, in whole decades.
[[nodiscard]] LogRange range_around(double usual, bool zero_at_left);

// Before a field: gives it the keyboard where the slider below it was clicked with Ctrl.
void type_where_asked(const PanelContext& context, const char* id);

// Right after the field `id` and its unit, `from` to `to` across (on the screen). Returns the value
// while the user drags it.
[[nodiscard]] std::optional<double> thin_slider(const PanelContext& context, const char* id,
                                                double shown, const LogRange& range, float from,
                                                float to);

// All of it: label, field, unit and slider. The items are called `name` and "NAME-slider".
struct NumberRow {
  const char* name = "";
  std::string_view label;
  std::string_view unit;
  std::string_view tooltip;
  double value = 0.0;
  LogRange range;
};
[[nodiscard]] std::optional<double> slider_row(const PanelContext& context, const NumberRow& row);

}  // namespace hapticwall::ui
