// The small pieces that all panels are made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

// A heading of a section of the control panel.
void section(const PanelContext& context, const char* title);

// Text in the colour of secondary things, wrapped at the edge of the panel.
void muted_text(const PanelContext& context, std::string_view text);

// One of several buttons of which one is chosen.
[[nodiscard]] bool choice_button(const PanelContext& context, const char* label, bool chosen);

// Explains the last item when the pointer rests on it.
void explain(std::string_view text);

// A label on the left; the next item fills the rest of the row but for `unit`, which unit_label()
// adds.
void field_label(const PanelContext& context, std::string_view label, std::string_view tooltip,
                 std::string_view unit);
void unit_label(std::string_view unit);

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
