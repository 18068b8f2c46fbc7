// Stiffness, damping and position of a wall.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "app/ui/control_panel.h"
#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr double kMillimetresPerMetre = 1e3;
// Of the slider; any valid value can be typed.
constexpr double kSoftestN = 100.0;
constexpr double kStiffestN = 1e6;

void set_wall(const PanelContext& context, std::size_t index, const WallSettings& wall) {
  std::vector<WallSettings> walls = context.session.scene().walls;
  walls[index] = wall;
  if (const auto problem = context.session.set_walls(walls)) tell(context.state, *problem);
}

void draw_chooser(const PanelContext& context, std::size_t count) {
  std::size_t& chosen = context.state.transient.chosen_wall;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(fmt::format("wall {}", i + 1).c_str(), chosen == i)) chosen = i;
  }
}

void draw_stiffness(const PanelContext& context, std::size_t index, WallSettings wall) {
  field_label(context, "stiffness",
              "K, how many newtons a metre of penetration costs. Typed: any valid value.", "N/m");
  if (const auto typed = number_field(context, "##stiffness", wall.stiffness_n_per_m)) {
    wall.stiffness_n_per_m = *typed;
    set_wall(context, index, wall);
  }
  remember_item(context.state, "stiffness");
  unit_label("N/m");
  ImGui::SetNextItemWidth(-1.0F);
  double slid = wall.stiffness_n_per_m;
  if (ImGui::SliderScalar("##stiffness-slider", ImGuiDataType_Double, &slid, &kSoftestN,
                          &kStiffestN, "",
                          ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput)) {
    wall.stiffness_n_per_m = slid;
    set_wall(context, index, wall);
  }
  remember_item(context.state, "stiffness-slider");
  explain("Stiffness from 100 N/m to 1 MN/m, logarithmic.");
}

void draw_damping(const PanelContext& context, std::size_t index, WallSettings wall) {
  field_label(context, "damping",
              "B, the wall's own damping. The hold turns it into energy, too (Eq. 13).", "N·s/m");
  if (const auto typed = number_field(context, "##damping", wall.damping_n_s_per_m)) {
    wall.damping_n_s_per_m = *typed;
    set_wall(context, index, wall);
  }
  remember_item(context.state, "damping");
  unit_label("N·s/m");
}

void draw_position(const PanelContext& context, std::size_t index, WallSettings wall) {
  field_label(context, "position", "x_w, where the face of the wall is; x grows into the wall.",
              "mm");
  if (const auto typed =
          number_field(context, "##position", wall.position_m * kMillimetresPerMetre)) {
    wall.position_m = *typed / kMillimetresPerMetre;
    set_wall(context, index, wall);
  }
  remember_item(context.state, "position");
  unit_label("mm");
}

}  // namespace

void draw_wall_section(const PanelContext& context) {
  section(context, "Wall");
  const std::vector<WallSettings>& walls = context.session.scene().walls;
  if (walls.empty()) {
    muted_text(context, "This scene has no wall.");
    return;
  }
  std::size_t& chosen = context.state.transient.chosen_wall;
  chosen = std::min(chosen, walls.size() - 1);
  if (walls.size() > 1) draw_chooser(context, walls.size());
  // Each takes the wall as it is now: the one before may have changed it.
  draw_stiffness(context, chosen, context.session.scene().walls[chosen]);
  draw_damping(context, chosen, context.session.scene().walls[chosen]);
  draw_position(context, chosen, context.session.scene().walls[chosen]);
}

}  // namespace hapticwall::ui
