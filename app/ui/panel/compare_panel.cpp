#include <fmt/format.h>

#include <string>

#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/comparing.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

using compare::Slot;

constexpr float kNameAtEms = 1.6F;  // start of the name, behind the slot's letter

// Shows the other slot's contact in the plots.
void draw_ghost_switch(const PanelContext& context) {
  ImGui::Checkbox("ghost", &context.compare.persisted.ghost_shown);
  explain("Draws the other slot's newest contact over the present one in the plots.");
}

// Draws the button at the right end of its row if it fits, else below.
void draw_take_button(const PanelContext& context, Slot slot, float name_ends, float right) {
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  const std::string label = fmt::format("take present###take {}", compare::slot_name(slot));
  const float width = button_width(label.c_str());
  if (name_ends + ImGui::GetStyle().ItemSpacing.x + width <= right) ImGui::SameLine(right - width);
  if (ImGui::SmallButton(label.c_str())) take_present(context, slot);
  ImGui::PopFont();
  explain(fmt::format("Copies the present algorithm and its values into slot {}.",
                      compare::slot_name(slot)));
}

void draw_in_force(const PanelContext& context, float name_ends, float right) {
  const char* text = asked_for(context).algorithm ? "asked for" : "in force";
  const float width = ImGui::CalcTextSize(text).x;
  if (name_ends + ImGui::GetStyle().ItemSpacing.x + width > right) return;
  ImGui::SameLine(right - width);
  ImGui::TextColored(context.theme.colour(draw::Tone::kAccent), "%s", text);
}

void draw_slot(const PanelContext& context, Slot slot) {
  const CompareSlots slots = slots_of(context.compare);
  const AlgorithmSettings& settings = slots.of(slot);
  const bool active = slots.active == slot;
  const std::string name(compare::slot_name(slot));
  const float left = ImGui::GetCursorPosX();
  const float right = left + ImGui::GetContentRegionAvail().x;
  const float indent = left + ems(kNameAtEms);
  const bool clicked = ImGui::Selectable(fmt::format("{0}###slot {0}", name).c_str(), active,
                                         ImGuiSelectableFlags_AllowOverlap);
  explain(fmt::format("{}\n{}", compare::describe(settings),
                      active ? "The active slot: what you change now changes it."
                             : "A click or Tab activates it, without a jump of the force."));
  ImGui::SameLine(indent);
  ImGui::TextUnformatted(algorithm_name(settings).c_str());
  const float name_ends = indent + ImGui::GetItemRectSize().x;
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
  if (!context.compare.transient.comparison) return;
  const CompareSlots slots = slots_of(context.compare);
  const std::string summary = fmt::format("{} and {}", algorithm_name(slots.of(Slot::kA)),
                                          algorithm_name(slots.of(Slot::kB)));
  bool& open = context.compare.persisted.open;
  ImGui::SetNextItemOpen(open);
  open = folding_section(context, "Compare", summary);
  explain("Two algorithms to switch between (Tab), and what follows the algorithm in force.");
  if (!open) return;
  draw_slot(context, Slot::kA);
  draw_slot(context, Slot::kB);
  draw_ghost_switch(context);
}

}  // namespace hapticwall::ui
