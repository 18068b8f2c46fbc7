#include <fmt/format.h>

#include <array>
#include <span>
#include <string>

#include "app/file/scene/device_file.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

const std::array kRows{
    ParameterText{"mass_kg", "mass",
                  "m in m dv/dt = F_h - F_a - b v - f_c sgn(v): mass of the handle and all that "
                  "moves with it",
                  0.05},
    ParameterText{"damping_n_s_per_m", "damping",
                  "b, viscous; it makes stiff walls possible: b >= K T/2 + B (Eq. 18)", 1.0},
    ParameterText{"friction_n", "friction",
                  "f_c, Coulomb friction: the handle sticks while |F_h - F_a| <= f_c, and slips",
                  0.14},
    ParameterText{
        "static_friction_n", "static friction",
        "f_s: friction of a handle that breaks loose; with the speed it falls to f_c. Not "
        "for the exact integrator",
        0.2},
    ParameterText{"stribeck_speed_m_per_s", "Stribeck speed",
                  "v_s in f_c + (f_s - f_c)/(1 + (v/v_s)²)", 0.01},
    ParameterText{"encoder_m", "encoder",
                  "Δ, the count of the position sensor: the controller sees x = Δ round(x / Δ)",
                  0.254e-3},
    ParameterText{
        "position_noise_m", "position noise",
        "standard deviation of the position sensor's noise, new in every tick, before the "
        "encoder counts",
        10e-6},
    ParameterText{"force_limit_n", "force limit", "F_max: the largest force of the actuator", 8.9},
    ParameterText{"max_force_rate_n_per_s", "force rate",
                  "the fastest rise of the commanded force; it falls at once", 5e3},
    ParameterText{"force_noise_n", "force noise",
                  "standard deviation of the amplifier's noise, new in every tick", 0.01},
    ParameterText{"force_resolution_n", "force step", "resolution of the actuator's force", 0.01},
    ParameterText{"delay_ticks", "delay",
                  "delay between command and amplifier, in ticks of length T", 1.0},
    ParameterText{"amplifier_time_constant_s", "lag",
                  "τ in τ dF_a/dt = F - F_a: the amplifier follows as a first-order lag", 1e-3}};

// The other parameters of a real device cannot be set.
constexpr std::size_t kBelievedRows = 3;

std::string summary(const DeviceSettings& device) {
  return fmt::format("{} kg, {} N·s/m", rounded_number(device.mass_kg),
                     rounded_number(device.damping_n_s_per_m));
}

std::string microseconds(double newest_s, double most_s) {
  return fmt::format("{:5.0f} µs, max {:5.0f} µs", newest_s * kMicrosecondsPerSecond,
                     most_s * kMicrosecondsPerSecond);
}

// Text for an acknowledged command; without one it is unknown, not 0.
std::string answered(double value_s, const std::string& text) {
  return value_s > 0.0 ? text : "unknown";
}

void take_device(const PanelContext& context, const std::string& name) {
  const Result<Scene> wanted = file::with_device(context.session.scene(), name);
  if (!wanted) return tell(context.toasts, wanted.error());
  if (const auto problem = ask_for(context, *wanted)) tell(context.toasts, *problem);
}

// The presets; and a field, which takes every name that --set device=NAME takes.
void draw_device_choices(const PanelContext& context) {
  for (const file::BuiltinDevice& builtin : file::builtin_devices()) {
    const auto device = file::load_device(builtin.name);
    if (!device || device->vendor_id != 0) continue;
    if (list_choice(fmt::format("{}###take device {}", device->name, builtin.name), false,
                    device->source))
      take_device(context, builtin.name);
  }
  if (!context.can.files) return;
  ImGui::Separator();
  ImGui::SetNextItemWidth(-1.0F);
  const auto path = text_field(context, "##device file", "name or path", "");
  explain("Takes the numbers of this device file, such as 'identify' writes");
  if (!path || path->empty()) return;
  take_device(context, *path);
  ImGui::CloseCurrentPopup();
}

// Numbers that the file of the device does not have stay, so that no device is "chosen".
void draw_device_list(const PanelContext& context) {
  constexpr const char* kMeaning =
      "Replaces the numbers below by those of a known device, as --set device=NAME does. A number "
      "that is not known of it stays. The tooltips name the sources.";
  field_label(context, "numbers of", kMeaning, "");
  if (ImGui::BeginCombo("##device numbers", "a device ...")) {
    draw_device_choices(context);
    ImGui::EndCombo();
  }
  explain(kMeaning);
}

void draw_rows(const PanelContext& context, std::span<const ParameterText> rows) {
  draw_device_list(context);
  for (const ParameterText& text : rows) {
    const auto& key = key_called<DeviceSettings>(text.key);
    const ParameterRow row = parameter_row("device.", key, text, context.session.scene().x().device,
                                           context.scene.loaded.x().device);
    const auto edit = draw_parameter_row(context, row);
    if (!edit) continue;
    change_parameters(context, row.key,
                      [&](Scene& scene) { assign(key, scene.x().device, edit->value); });
  }
}

// A wheel of the kernel reports only the time of its last motion.
void draw_wheel(const PanelContext& context, const device::LinkStats& link) {
  figure_row(context, "changes", fmt::format("{}", link.states), draw::Tone::kText,
             "Positions received since the start. The kernel reports changes only: a wheel at rest "
             "sends none.");
  figure_row(context, "tried", "never on this model", draw::Tone::kWarning,
             "Nobody has felt this program's force on a wheel. Keep your hands off the spokes, and "
             "an emergency stop within reach.");
}

void draw_times(const PanelContext& context, const device::LinkStats& link) {
  figure_row(
      context, "age", microseconds(link.age_s, link.maximum_age_s), draw::Tone::kText,
      "Age of the position when the loop used it. The loop rejects positions older than 20 ms.");
  figure_row(context, "write", microseconds(link.write_time_s, link.maximum_write_time_s),
             draw::Tone::kText,
             "Time for handing a command to the operating system. The loop never waits for it.");
  figure_row(
      context, "round trip",
      answered(link.round_trip_s, microseconds(link.round_trip_s, link.maximum_round_trip_s)),
      draw::Tone::kText,
      "From the latch of a position to the arrival of the command that it led to, by the "
      "device's own clock.");
  const std::string date = context.session.device_info().delay_date;
  figure_row(
      context, "delay",
      answered(link.delay_s, fmt::format("{:5.0f} µs{}", link.delay_s * kMicrosecondsPerSecond,
                                         date.empty() ? "" : ", measured " + date)),
      draw::Tone::kText,
      "t_d, from the latch of a position to the tick at which its force acted. It reduces "
      "the stable stiffness: see the wall.");
}

void draw_losses(const PanelContext& context, const device::LinkStats& link) {
  figure_row(context, "link lost", fmt::format("{} times", link.losses),
             link.losses > 0 ? draw::Tone::kWarning : draw::Tone::kText,
             "Each loss switched the force off and started a search for the device.");
}

void draw_counts(const PanelContext& context, const device::LinkStats& link) {
  const bool lossy = link.missing_states + link.void_reports > 0;
  figure_row(
      context, "reports",
      fmt::format("{}, {} missing, {} void", link.states, link.missing_states, link.void_reports),
      lossy ? draw::Tone::kWarning : draw::Tone::kText,
      "Valid positions since the start; missing ones, by their number; and invalid reports.");
  draw_losses(context, link);
  const bool moved = !link.calibrated && link.connected;
  figure_row(context, "count 0", moved ? "where it began" : "calibrated",
             moved ? draw::Tone::kWarning : draw::Tone::kText,
             "An uncalibrated device counts as at the scene's start when its link comes up.");
}

}  // namespace

void draw_device_section(const PanelContext& context) {
  const std::string title = summary(context.session.scene().x().device);
  if (context.session.device_info().is_simulated) {
    if (folding_section(context, "Device", title, asked_for(context).device))
      draw_rows(context, kRows);
    return;
  }
  section(context, "Device");
  draw_times(context, context.snapshot.link);
  if (context.snapshot.link.acknowledges) {
    draw_counts(context, context.snapshot.link);
  } else {
    draw_wheel(context, context.snapshot.link);
    draw_losses(context, context.snapshot.link);
  }
  if (folding_section(context, "Believed of it", title, asked_for(context).device)) {
    draw_rows(context, std::span(kRows).first(kBelievedRows));
  }
}

}  // namespace hapticwall::ui
