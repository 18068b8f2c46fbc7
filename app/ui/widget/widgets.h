// Widgets that all panels use.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/ui/state/changed_values.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

using draw::button_width;
using draw::ems;
using draw::FontScope;

// Start of a row's field, as a share of the panel's width.
inline constexpr float kLabelShare = 0.37F;

// Bold text in the colour of headings.
void heading_text(const PanelContext& context, const char* title);

// Heading of a section. `asked_for`: its values are not in force yet, and the heading says so.
void section(const PanelContext& context, const char* title, bool asked_for = false);

// Heading of a folding section, closed at first, with `summary` beside it. Returns true while open.
[[nodiscard]] bool folding_section(const PanelContext& context, const char* title,
                                   std::string_view summary, bool asked_for = false);

// Secondary text, wrapped at the edge of the panel.
// Continues the row if `width` fits, else begins a new one.
void beside(float width, float gap = -1.0F);
void muted_text(const PanelContext& context, std::string_view text);

// Progress bar as wide as the panel. `fraction`: 0 to 1.
void progress_bar(const PanelContext& context, double fraction, const std::string& text);

// Shows a tooltip for the last item.
void explain(std::string_view text);
// Shows a tooltip for the tab of the current window, beside the window.
void explain_tab(std::string_view text);

// A button with a tooltip; true when pressed.
struct ButtonLook {
  float width = 0.0F;  // pixels; 0: as wide as the label
  bool enabled = true;
  bool small = false;
};
[[nodiscard]] bool button(const std::string& label, std::string_view tooltip,
                          const ButtonLook& look = {});

// button() for a choice; `chosen` highlights it.
[[nodiscard]] bool choice_button(const PanelContext& context, const std::string& label, bool chosen,
                                 std::string_view tooltip, const ButtonLook& look = {});

// A row of a list that is open; true when the user chooses it.
[[nodiscard]] bool list_choice(const std::string& label, bool chosen,
                               std::string_view tooltip = {});

// A label on the left. The next item fills the rest of the row, except the width of `unit`, which
// unit_label() adds. A field that follows has the same tooltip.
void field_label(const PanelContext& context, std::string_view label, std::string_view tooltip,
                 std::string_view unit);
void unit_label(std::string_view unit);
// Width reserved for the unit of a field.
[[nodiscard]] float unit_width(std::string_view unit);

// Text in small digits of constant width.
void digits_text(const PanelContext& context, const std::string& text, draw::Tone tone);

// A row that shows a value: name, and digits of constant width.
void figure_row(const PanelContext& context, std::string_view name, const std::string& text,
                draw::Tone tone, std::string_view tooltip);

// A text field. Returns the new text once, when the user confirms it (Enter, Tab, or a click
// elsewhere). Escape cancels.
[[nodiscard]] std::optional<std::string> text_field(const PanelContext& context, const char* id,
                                                    const std::string& hint,
                                                    const std::string& shown);

// Shows below the field of `key` why its newest text was refused.
void refuse(const PanelContext& context, const std::string& key, std::string why);
[[nodiscard]] bool is_refused(const PanelContext& context, std::string_view key);
// Draws the refusal of `key` in one line, if there is one; the tooltip has all of it.
void draw_refusal(const PanelContext& context, const std::string& key);

// Upper left corner of the tooltip of an item. It never covers the item's row in its window, nor
// the next one below. Beside a narrow window, else a row below the item, else a row above. Pixels.
struct TooltipSpace {
  ImVec2 item_from;
  ImVec2 item_to;
  ImVec2 window_from;
  ImVec2 window_to;
  ImVec2 screen;
  float row = 0.0F;  // height, with the padding of a window that may begin there
};
[[nodiscard]] ImVec2 tooltip_place(const TooltipSpace& space, ImVec2 size);
// The same for the tab of a window. It covers neither the tab nor the first fields of the window:
// beside a narrow window, else above it, else at the bottom of the screen.
[[nodiscard]] ImVec2 tab_tooltip_place(const TooltipSpace& space, ImVec2 size);

// text_field() for a number. Refuses invalid input under the key `id` and returns nullopt.
[[nodiscard]] std::optional<double> number_field(const PanelContext& context, const char* id,
                                                 double shown);

}  // namespace hapticwall::ui
