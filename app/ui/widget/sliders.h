// Numbers of wide range: a field to type in, and a thin logarithmic slider below it.
#pragma once

#include <optional>
#include <string_view>

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Range of the slider; values beyond it can be typed.
struct LogRange {
  double minimum = 1.0;  // more than 0
  double maximum = 10.0;
  bool zero_at_left = false;  // true: the left end means 0
};

// Slider position (0 to 1) and value. Values have three digits, the resolution of the slider.
[[nodiscard]] double slider_share(double value, const LogRange& range);
[[nodiscard]] double slider_value(double share, const LogRange& range);

// A decade and a half on either side of a usual value, rounded to whole decades.
[[nodiscard]] LogRange range_around(double usual, bool zero_at_left);

// Call it before a field: gives it the keyboard after a Ctrl+click on its slider.
void type_where_asked(const PanelContext& context, const char* id);

// Call it right after the field `id` and its unit; `from` to `to` in screen pixels. Returns the
// value while the user drags.
[[nodiscard]] std::optional<double> thin_slider(const PanelContext& context, const char* id,
                                                double shown, const LogRange& range, float from,
                                                float to);

// A row of label, field, unit and slider. The ids are "##NAME" and "##NAME-slider".
struct NumberRow {
  const char* name = "";
  std::string_view label;
  std::string_view unit;
  std::string_view tooltip;
  double value = 0.0;
  std::optional<LogRange> range = std::nullopt;  // range of the slider; nullopt: no slider
};
// Returns the value that the user has typed, or to which the slider is dragged.
[[nodiscard]] std::optional<double> number_row(const PanelContext& context, const NumberRow& row);

}  // namespace hapticwall::ui
