#include "app/ui/shown_axis.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

struct Choice {
  Axis axis;
  const char* text;
};
constexpr std::array kChoices{Choice{Axis::kX, "x"}, Choice{Axis::kY, "y"}};

}  // namespace

bool shows_second_axis(const PanelContext& context) {
  return context.session.scene().y && context.state.transient.shown_axis == Axis::kY;
}

Scene shown_scene(const PanelContext& context) {
  if (shows_second_axis(context)) return second_axis(context.session.scene());
  Scene scene = context.session.scene();
  scene.y.reset();
  return scene;
}

const std::vector<WallSettings>& shown_walls(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  return shows_second_axis(context) ? scene.y->walls : scene.walls;
}

const Sample& shown_sample(const PanelContext& context) {
  return shows_second_axis(context) ? context.snapshot.y : context.snapshot.sample;
}

std::optional<SceneProblem> set_shown_walls(const PanelContext& context,
                                            const std::vector<WallSettings>& walls) {
  if (!shows_second_axis(context)) return context.session.set_walls(walls);
  Scene changed = context.session.scene();
  changed.y->walls = walls;
  return context.session.change_scene(changed);
}

void draw_axis_choice(const PanelContext& context, const char* name) {
  if (!context.session.scene().y) return;
  Axis& shown = context.state.transient.shown_axis;
  for (const Choice& choice : kChoices) {
    ImGui::PushID(choice.text);
    if (choice_button(context, choice.text, shown == choice.axis)) shown = choice.axis;
    ImGui::PopID();
    remember_item(context.state, fmt::format("{} axis {}", name, choice.text));
    explain("The axis that plots, magnifier, readout and the fields of the wall are of");
    ImGui::SameLine();
  }
}

}  // namespace hapticwall::ui
