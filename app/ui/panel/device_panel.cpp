// The device. Simulated: mass, losses, sensor and actuator, all of which may change while it runs.
// Real: what its link measures, and what the algorithms believe of it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "app/ui/control_panel.h"
#include "app/ui/parameter_rows.h"
#include "app/ui/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

const std::array kRows{
    ParameterText{"mass_kg", "mass",
                  "m in m dv/dt = F_h - F_a - b v - f_c sgn(v): the handle and all that moves with "
                  "it",
                  0.05},
    ParameterText{"damping_n_s_per_m", "damping",
                  "b, viscous: what makes stiff walls possible, b >= K T/2 + B (Eq. 18)", 1.0},
    ParameterText{"friction_n", "friction",
                  "f_c, Coulomb friction: the handle sticks while |F_h - F_a| <= f_c, and slips",
                  0.14},
    ParameterText{"encoder_m", "encoder",
                  "Δ, the count of the position sensor: x = Δ round(x / Δ) is all that the "
                  "controller sees",
                  0.254e-3},
    ParameterText{"force_limit_n", "force limit", "F_max: what the actuator can give at most", 8.9},
    ParameterText{"force_resolution_n", "force step",
                  "the actuator's force comes in whole steps of this", 0.01},
    ParameterText{"delay_ticks", "delay",
                  "whole ticks between a command and the amplifier, each of them T long", 1.0},
    ParameterText{"amplifier_time_constant_s", "lag",
                  "τ in τ dF_a/dt = F - F_a: the amplifier follows as a first-order lag", 1e-3}};

// Of a real device everything else is its own and cannot be set.
constexpr std::size_t kBelievedRows = 3;

std::string summary(const DeviceSettings& device) {
  return fmt::format("{} kg, {} N·s/m", number_text(device.mass_kg),
                     number_text(device.damping_n_s_per_m));
}

std::string microseconds(double newest_s, double most_s) {
  return fmt::format("{:5.0f} µs, most {:5.0f} µs", newest_s * kMicrosecondsPerSecond,
                     most_s * kMicrosecondsPerSecond);
}

void draw_rows(const PanelContext& context, std::span<const ParameterText> rows) {
  for (const ParameterText& text : rows) {
    const auto& key = key_called(device_number_keys(), text.key);
    const ParameterRow row = parameter_row("device.", key, text, context.session.scene().device,
                                           context.state.transient.loaded_scene.device);
    const auto edit = draw_parameter_row(context, row);
    if (!edit) continue;
    change_parameters(context, row.key,
                      [&](Scene& scene) { assign(key, scene.device, edit->value); });
  }
}

void draw_times(const PanelContext& context, const device::LinkFigures& link) {
  figure_row(context, "age", microseconds(link.age_s, link.maximum_age_s), Tone::kText,
             "How old the position was when the loop acted upon it. From 20 ms on it is not acted "
             "upon.");
  remember_item(context.state, "age");
  figure_row(context, "write", microseconds(link.write_time_s, link.maximum_write_time_s),
             Tone::kText,
             "How long a command took into the operating system; the loop never waits "
             "for it.");
  figure_row(context, "round trip", microseconds(link.round_trip_s, link.maximum_round_trip_s),
             Tone::kText,
             "From the latch of a position to the arrival of the command that it led to, by the "
             "device's own clock.");
  figure_row(
      context, "delay", fmt::format("{:5.0f} µs", link.delay_s * kMicrosecondsPerSecond),
      Tone::kText,
      "t_d, from the latch of a position to the tick at which its force acted. It takes from "
      "the stiffness that is stable: see the wall.");
  remember_item(context.state, "delay");
}

void draw_counts(const PanelContext& context, const device::LinkFigures& link) {
  const bool lossy = link.missing_states + link.void_reports > 0;
  figure_row(
      context, "reports",
      fmt::format("{}, {} missing, {} void", link.states, link.missing_states, link.void_reports),
      lossy ? Tone::kWarning : Tone::kText,
      "Valid positions since the start; those that never came, by their numbering; and "
      "reports that were not to be understood.");
  remember_item(context.state, "reports");
  figure_row(context, "link lost", fmt::format("{} times", link.losses),
             link.losses > 0 ? Tone::kWarning : Tone::kText,
             "Each time the force went off, and the device was looked for again.");
  const bool moved = !link.calibrated && link.connected;
  figure_row(context, "count 0", moved ? "where it began" : "calibrated",
             moved ? Tone::kWarning : Tone::kText,
             "A device that is not calibrated is taken to be at the scene's start when its link "
             "comes up.");
}

}  // namespace

void draw_device_section(const PanelContext& context) {
  const std::string title = summary(context.session.scene().device);
  if (context.session.device_info().is_simulated) {
    if (folding_section(context, "Device", title)) draw_rows(context, kRows);
    return;
  }
  section(context, "Device");
  draw_times(context, context.snapshot.link);
  draw_counts(context, context.snapshot.link);
  if (folding_section(context, "Believed of it", title)) {
    draw_rows(context, std::span(kRows).first(kBelievedRows));
  }
}

}  // namespace hapticwall::ui
