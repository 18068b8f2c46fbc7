// The small pieces that all panels are made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// Where a row's field begins, of the width of the panel.
inline constexpr float kLabelShare = 0.37F;

// A heading of a section of the control panel.
void section(const PanelContext& context, const char* title);

// A heading that opens and closes its section; closed at first, with `summary` beside it. True:
// open.
[[nodiscard]] bool folding_section(const PanelContext& context, const char* title,
                                   std::string_view summary);

// Text in the colour of secondary things, wrapped at the edge of the panel.
void muted_text(const PanelContext& context, std::string_view text);

// One of several buttons of which one is chosen.
[[nodiscard]] bool choice_button(const PanelContext& context, const char* label, bool chosen);

// Explains the last item when the pointer rests on it.
void explain(std::string_view text);

// A label on the left; the next item fills the rest of the row but for `unit`, which unit_label()
// adds. A text or number field that follows has the same tooltip.
void field_label(const PanelContext& context, std::string_view label, std::string_view tooltip,
                 std::string_view unit);
void unit_label(std::string_view unit);
// The width that a field leaves free for its unit.
[[nodiscard]] float unit_width(std::string_view unit);

// A figure that is looked at and not typed: name, and digits of constant width.
void figure_row(const PanelContext& context, std::string_view name, const std::string& text,
                Tone tone, std::string_view tooltip);

// A field that shows `shown` and is typed into. Returns the new text once, when the user has
// confirmed it (Enter, Tab, or a click elsewhere); Escape leaves things as they are.
[[nodiscard]] std::optional<std::string> text_field(const PanelContext& context, const char* id,
                                                    const std::string& hint,
                                                    const std::string& shown);

// The same for a number, which must be one; else the user is told, and nothing is returned.
[[nodiscard]] std::optional<double> number_field(const PanelContext& context, const char* id,
                                                 double shown);

// A finite number as people type it, `.` as decimal point, or nothing.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

// As short as possible, without the noise of the last binary digits.
[[nodiscard]] std::string number_text(double value);

}  // namespace hapticwall::ui
