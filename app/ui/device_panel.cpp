// The simulated device: mass, losses, sensor and actuator, all of which may change while it runs.
#include <fmt/format.h>

#include <array>
#include <string>

#include "app/ui/control_panel.h"
#include "app/ui/parameter_rows.h"
#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

const std::array kRows{
    ParameterText{"mass_kg", "mass", "m, of the handle and all that moves with it", 0.05},
    ParameterText{"damping_n_s_per_m", "damping", "b, viscous: what makes stiff walls possible",
                  1.0},
    ParameterText{"friction_n", "friction", "f_c, Coulomb friction: the handle sticks and slips",
                  0.14},
    ParameterText{"encoder_m", "encoder", "Δ, the count of the position sensor", 0.254e-3},
    ParameterText{"force_limit_n", "force limit", "what the actuator can give at most", 8.9},
    ParameterText{"force_resolution_n", "force step",
                  "the actuator's force comes in whole steps of this", 0.01},
    ParameterText{"delay_ticks", "delay", "whole ticks between a command and the amplifier", 1.0},
    ParameterText{"amplifier_time_constant_s", "lag",
                  "τ of an amplifier that follows as a first-order lag", 1e-3}};

std::string summary(const DeviceSettings& device) {
  return fmt::format("{} kg, {} N·s/m", number_text(device.mass_kg),
                     number_text(device.damping_n_s_per_m));
}

}  // namespace

void draw_device_section(const PanelContext& context) {
  if (!folding_section(context, "Device", summary(context.session.scene().device))) return;
  for (const ParameterText& text : kRows) {
    const auto& key = key_called(device_number_keys(), text.key);
    const ParameterRow row = parameter_row("device.", key, text, context.session.scene().device,
                                           context.state.transient.loaded_scene.device);
    const auto edit = draw_parameter_row(context, row);
    if (!edit) continue;
    change_parameters(context, row.key,
                      [&](Scene& scene) { assign(key, scene.device, edit->value); });
  }
}

}  // namespace hapticwall::ui
