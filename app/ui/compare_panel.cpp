// Two slots: which algorithms are felt in turn.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/ui/comparing.h"
#include "app/ui/control_panel.h"
#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

using runtime::Slot;

constexpr const char* kTake = "Take the present one";
constexpr float kNameAtEms = 1.6F;  // behind the slot's letter

// Beside the heading: whether the plots show the other slot's contact.
void draw_ghost_switch(const PanelContext& context) {
  bool& shown = context.state.compare.persisted.ghost_shown;
  ImGui::PushFont(nullptr, kSmallFontSize);
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(style.FramePadding.x, 0.25F * style.FramePadding.y));
  const float width =
      ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + ImGui::CalcTextSize("ghost").x;
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  ImGui::Checkbox("ghost", &shown);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  remember_item(context.state, "ghost");
  explain(
      "Draws the other slot's newest contact over the present one in the plots, softly, from its "
      "beginning on.");
}

void draw_take_button(const PanelContext& context, Slot slot) {
  ImGui::PushFont(nullptr, kSmallFontSize);
  if (ImGui::SmallButton(kTake)) take_present(context, slot);
  ImGui::PopFont();
  remember_item(context.state, fmt::format("take {}", runtime::slot_name(slot)));
  explain(fmt::format("Stores the algorithm in force, with its values, in slot {}.",
                      runtime::slot_name(slot)));
}

void draw_slot(const PanelContext& context, Slot slot) {
  const CompareSlots slots = slots_of(context.state);
  const AlgorithmSettings& settings = slots.of(slot);
  const bool active = slots.active == slot;
  const std::string name(runtime::slot_name(slot));
  const float left = ImGui::GetCursorPosX();
  ImGui::PushID(name.c_str());
  const bool clicked = ImGui::Selectable(fmt::format("{}##slot", name).c_str(), active);
  remember_item(context.state, "slot " + name);
  explain(fmt::format("{}\n{}", runtime::describe(settings),
                      active ? "It is in force: what you change now changes this slot."
                             : "A click or Tab puts it in force, without a jump of the force."));
  const float indent = left + kNameAtEms * ImGui::GetFontSize();
  ImGui::SameLine(indent);
  ImGui::TextUnformatted(algorithm_name(settings).c_str());
  if (active) {
    const float width = ImGui::CalcTextSize("in force").x;
    ImGui::SameLine(left + ImGui::GetContentRegionMax().x - ImGui::GetStyle().WindowPadding.x -
                    width);
    ImGui::TextColored(context.theme.colour(Tone::kAccent), "in force");
  }
  const std::string keys = set_keys_text(settings);
  if (!keys.empty()) {
    ImGui::SetCursorPosX(indent);
    muted_text(context, keys);
  }
  if (!active) {
    ImGui::SetCursorPosX(indent);
    draw_take_button(context, slot);
  }
  ImGui::PopID();
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
