#include <fmt/format.h>

#include <string>

#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/comparing.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

using compare::Slot;

constexpr float kNameAtEms = 1.6F;  // behind the slot's letter

// Switch beside the heading: shows the other slot's contact in the plots.
void draw_ghost_switch(const PanelContext& context) {
  bool& shown = context.state.compare.persisted.ghost_shown;
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(style.FramePadding.x, 0.25F * style.FramePadding.y));
  const float width =
      ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + ImGui::CalcTextSize("ghost").x;
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  ImGui::Checkbox("ghost", &shown);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  explain("Draws the other slot's newest contact over the present one in the plots.");
}

std::string take_label(Slot slot) {
  return fmt::format("take present###take {}", compare::slot_name(slot));
}

float take_width(Slot slot) {
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  return button_width(take_label(slot).c_str());
}

// At the right end of its row where it fits, else below.
void draw_take_button(const PanelContext& context, Slot slot, float name_ends, float right) {
  const float from = right - take_width(slot);
  if (name_ends <= from) ImGui::SameLine(from);
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  if (ImGui::SmallButton(take_label(slot).c_str())) take_present(context, slot);
  ImGui::PopFont();
  explain(fmt::format("Copies the present algorithm and its values into slot {}.",
                      compare::slot_name(slot)));
}

void draw_in_force(const PanelContext& context, float name_ends, float right) {
  const char* text = asked_for(context).algorithm ? "asked for" : "in force";
  const float width = ImGui::CalcTextSize(text).x;
  if (name_ends + width > right) return;
  ImGui::SameLine(right - width);
  ImGui::TextColored(context.theme.colour(draw::Tone::kAccent), "%s", text);
}

// The row of a slot; true when clicked.
bool draw_slot_row(const AlgorithmSettings& settings, Slot slot, bool active, float width) {
  const std::string name(compare::slot_name(slot));
  const bool clicked = ImGui::Selectable(fmt::format("{0}###slot {0}", name).c_str(), active,
                                         ImGuiSelectableFlags_None, ImVec2(width, 0.0F));
  explain(fmt::format("{}\n{}", compare::describe(settings),
                      active ? "The active slot: what you change now changes it."
                             : "A click or Tab activates it, without a jump of the force."));
  return clicked;
}

void draw_slot(const PanelContext& context, Slot slot) {
  const CompareSlots slots = slots_of(context.state);
  const AlgorithmSettings& settings = slots.of(slot);
  const bool active = slots.active == slot;
  const float left = ImGui::GetCursorPosX();
  const float right = left + ImGui::GetContentRegionAvail().x;
  const float indent = left + ems(kNameAtEms);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float name_ends = indent + ImGui::CalcTextSize(algorithm_name(settings).c_str()).x + gap;
  // The keyboard finds the button only beside the row, not within it.
  const float row_ends = right - take_width(slot) - gap;
  const bool beside_row = !active && name_ends <= row_ends;
  const bool clicked = draw_slot_row(settings, slot, active, beside_row ? row_ends - left : 0.0F);
  ImGui::SameLine(indent);
  ImGui::TextUnformatted(algorithm_name(settings).c_str());
  if (active) {
    draw_in_force(context, name_ends, right);
  } else {
    draw_take_button(context, slot, name_ends, right);
  }
  // Always a line, so that the rows below stay.
  const std::string keys = set_keys_text(settings);
  ImGui::SetCursorPosX(indent);
  muted_text(context, keys.empty() ? "with its defaults" : keys);
  if (clicked && !active) choose_slot(context, slot);
}

}  // namespace

void draw_compare_section(const PanelContext& context) {
  if (!context.state.compare.transient.comparison) return;
  section(context, "Compare");
  draw_ghost_switch(context);
  draw_slot(context, Slot::kA);
  draw_slot(context, Slot::kB);
}

}  // namespace hapticwall::ui
