#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/widget/part_choice.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/sliders.h"
#include "app/ui/widget/widgets.h"
#include "core/environment/environment.h"
#include "core/study/stability_bounds.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

// Range of the sliders; any valid value can be typed.
constexpr LogRange kStiffness{100.0, 1e6};
constexpr LogRange kDamping{0.01, 1000.0, true};

std::optional<SceneProblem> set_wall(const PanelContext& context, std::size_t index,
                                     const WallSettings& wall) {
  std::vector<WallSettings> walls = shown_walls(context);
  walls[index] = wall;
  return set_shown_walls(context, walls);
}

void draw_chooser(const PanelContext& context, std::size_t count) {
  std::size_t& chosen = context.selection.wall;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) ImGui::SameLine();
    const std::string label = fmt::format("wall {}", i + 1);
    if (ImGui::RadioButton(label.c_str(), chosen == i)) chosen = i;
    explain("Selects the wall for the fields below");
  }
}

// Each row reads the wall again, because the row above may have changed it.
void draw_row(const PanelContext& context, double WallSettings::*member, double scale,
              NumberRow row) {
  const std::size_t index = context.selection.wall;
  WallSettings wall = shown_walls(context)[index];
  row.value = wall.*member * scale;
  const auto value = number_row(context, row);
  if (!value) return;
  wall.*member = *value / scale;
  if (const auto problem = set_wall(context, index, wall))
    refuse(context, row.name, problem->message);
}

void draw_rows(const PanelContext& context) {
  draw_row(context, &WallSettings::stiffness_n_per_m, 1.0,
           {.name = "stiffness",
            .label = "stiffness",
            .unit = "N/m",
            .tooltip = "K in F_e = K p + B v (Eq. 11): force per metre of penetration p. From 0 to "
                       "1e9 N/m.",
            .range = kStiffness});
  draw_row(context, &WallSettings::damping_n_s_per_m, 1.0,
           {.name = "damping",
            .label = "damping",
            .unit = "N·s/m",
            .tooltip = "B in F_e = K p + B v (Eq. 11): damping of the wall, from 0 to 1e4 N·s/m. "
                       "The hold turns it into energy, too (Eq. 13).",
            .range = kDamping});
  draw_row(context, &WallSettings::position_m, kMillimetresPerMetre,
           {.name = "position",
            .label = "position",
            .unit = "mm",
            .tooltip = "x_w in p = x - x_w: position of the face, in mm, from -1000 to 1000; x "
                       "grows into the wall."});
}

void draw_bound(const PanelContext& context, std::string_view name,
                const std::optional<double>& bound_n_per_m, double stiffness_n_per_m,
                const std::string& tooltip, const char* without = "none") {
  // The row stays when a part is switched off, so that nothing moves.
  const bool over = bound_n_per_m && stiffness_n_per_m > *bound_n_per_m;
  figure_row(context, name, bound_n_per_m ? fmt::format("{:.0f} N/m", *bound_n_per_m) : without,
             over ? draw::Tone::kWarning : draw::Tone::kText,
             tooltip +
                 "\n\nThis is the bound of the bare wall, without an algorithm. It has this colour "
                 "if the wall "
                 "is stiffer.");
}

// Text about the stability limit: its contents, and the rule of thumb for it.
std::string stable_text(const PanelContext& context, const WallSettings& wall,
                        const StabilityBounds& bounds) {
  const std::optional<LoopDelay> delay = shown_delay(context);
  if (!delay) {
    return "Stable below it, in N/m. It depends on the delay of the device, and that is unknown.";
  }
  if (!bounds.stable_n_per_m) {
    return "Stable below it, in N/m. The estimator of velocity (Loop) is not linear, so that the "
           "limit depends on the motion.";
  }
  const bool simulated = context.session.device_info().is_simulated;
  const Scene scene = shown_scene(context);
  const std::string stable = fmt::format(
      "Stable below it, in N/m, by the eigenvalues of the sampled loop of handle, {}hold, wall and "
      "t_d = {:.0f} µs {}; without friction, encoder and force limit. 0: the softest walls are "
      "unstable, because B is too large or nothing damps.",
      simulated && scene.x().hand ? "hand, " : "", delay->total_s() * kMicrosecondsPerSecond,
      simulated ? "as simulated" : "as measured");
  if (!bounds.rule_n_per_m) return stable;
  return stable +
         fmt::format(
             "\n\nThe rule K < (b + B) / (T/2 + t_d) gives {:.0f} N/m. It is for B T/m below {:g}, "
             "here {:.2g}, and for a hand that only adds mass.",
             *bounds.rule_n_per_m, kMaxRuleDamping,
             wall.damping_n_s_per_m * scene.sampling.period_s() / scene.x().device.mass_kg);
}

void draw_bounds(const PanelContext& context, const WallSettings& wall) {
  const StabilityBounds bounds = shown_bounds(context, wall);
  const double stiffness = wall.stiffness_n_per_m;
  draw_bound(context, "bound, passive", bounds.passive_n_per_m, stiffness,
             "K < 2 (b - B) / T, in N/m (Eq. 18): creates no energy for any motion, except through "
             "the encoder. With a damper it is known for the backward difference only.",
             "unknown");
  draw_bound(context, "bound, stable", bounds.stable_n_per_m, stiffness,
             stable_text(context, wall, bounds), "unknown");
  draw_bound(context, "bound, friction", bounds.friction_n_per_m, stiffness,
             "K < 2 f_c / Δ, in N/m: friction can hold the handle between two counts.");
  draw_bound(context, "bound, resolution", bounds.resolution_n_per_m, stiffness,
             "K < F_max / Δ, in N/m: one count uses the whole force.");
}

// Another environment takes the place of the walls; `walls` brings those of the scene back.
void draw_environment(const PanelContext& context) {
  const PartChoice part{
      "environment", environments(), environment_parameters(), &Scene::environment,
      "What the handle touches. Another one than walls takes their place on all axes; walls brings "
      "those of the scene back. Changes during the session."};
  const Scene& loaded = context.scene.loaded;
  draw_part_menu(context, part, [&](Scene& scene, std::size_t index) {
    scene.environment.index = index;
    for (std::size_t i = 0; i < scene.axes.size(); ++i) {
      scene.axes[i].walls.clear();
      if (index == 0 && i < loaded.axes.size()) scene.axes[i].walls = loaded.axes[i].walls;
    }
  });
  draw_part_fields(context, part);
}

}  // namespace

void draw_wall_section(const PanelContext& context) {
  const AskedFor asked = asked_for(context);
  section(context, "Wall", asked.walls || asked.environment);
  draw_environment(context);
  if (!context.session.scene().environment.is_walls()) return;
  draw_axis_choice(context, "wall");
  if (context.session.scene().two_axes()) ImGui::NewLine();
  const std::vector<WallSettings>& walls = shown_walls(context);
  if (walls.empty()) {
    muted_text(context, context.session.scene().two_axes() ? "This axis has no wall."
                                                           : "This scene has no wall.");
    return;
  }
  std::size_t& chosen = context.selection.wall;
  chosen = std::min(chosen, walls.size() - 1);
  if (walls.size() > 1) draw_chooser(context, walls.size());
  draw_rows(context);
  draw_bounds(context, shown_walls(context)[chosen]);
}

}  // namespace hapticwall::ui
