#include "app/ui/widget/shown_axis.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "app/ui/state/changes.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

struct Choice {
  Axis axis;
  const char* text;
};
constexpr std::array kChoices{Choice{Axis::kX, "x"}, Choice{Axis::kY, "y"}};

}  // namespace

std::size_t shown_index(const PanelContext& context) {
  return context.shows.axis == Axis::kY ? 1 : 0;
}

Scene shown_scene(const PanelContext& context) {
  return axis_scene(context.session.scene(), shown_index(context));
}

const std::vector<WallSettings>& shown_walls(const PanelContext& context) {
  return context.session.scene().axes[shown_index(context)].walls;
}

const DeviceSettings& shown_device(const PanelContext& context) {
  return context.session.scene().axes[shown_index(context)].device;
}

const Sample& shown_sample(const PanelContext& context) {
  return context.snapshot.newest.axes[shown_index(context)];
}

std::optional<LoopDelay> shown_delay(const PanelContext& context) {
  if (context.session.device_info().is_simulated) return delay_of(shown_scene(context));
  const double delay_s = context.snapshot.link.delay_s;
  if (delay_s <= 0.0) return std::nullopt;
  return LoopDelay{.transport_s = delay_s, .time_constant_s = 0.0};
}

StabilityBounds shown_bounds(const PanelContext& context, const WallSettings& wall) {
  Scene scene = shown_scene(context);
  if (!context.session.device_info().is_simulated) scene.x().hand.reset();
  const std::optional<LoopDelay> delay = shown_delay(context);
  StabilityBounds bounds = stability_bounds(scene, wall, delay.value_or(LoopDelay{}));
  if (delay) return bounds;
  bounds.stable_n_per_m.reset();
  bounds.rule_n_per_m.reset();
  return bounds;
}

std::optional<SceneProblem> set_shown_walls(const PanelContext& context,
                                            const std::vector<WallSettings>& walls) {
  Scene changed = context.session.scene();
  changed.axes[shown_index(context)].walls = walls;
  return ask_for(context, changed);
}

void draw_axis_choice(const PanelContext& context, const char* name) {
  if (!context.session.scene().two_axes()) return;
  Axis& shown = context.selection.axis;
  for (const Choice& choice : kChoices) {
    const std::string label = fmt::format("{0}###{1} axis {0}", choice.text, name);
    if (choice_button(context, label, shown == choice.axis,
                      "Axis of plots, magnifier, readout and wall fields"))
      shown = choice.axis;
    ImGui::SameLine();
  }
}

}  // namespace hapticwall::ui
