#include "app/ui/panel/loop_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/ui/state/changes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/part_choice.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/sliders.h"
#include "app/ui/widget/widgets.h"
#include "core/estimator/estimator.h"
#include "core/summary.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kSubstepsKey = "simulator.substeps";

void draw_rate(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  const auto rate_hz =
      number_row(context, {"rate", "sampling rate", "Hz",
                           "Ticks of the real-time loop per second, 10 Hz to 100 kHz. A new rate "
                           "starts a new session from rest.",
                           scene.sampling.rate_hz});
  if (!rate_hz) return;
  Scene changed = scene;
  changed.sampling.rate_hz = *rate_hz;
  context.scene.wanted = WantedScene{std::move(changed)};
}

const std::array kSkippedRows{
    ParameterText{"render_every", "compute every",
                  "the controller computes on every n-th tick, with n times the period; the device "
                  "holds its force until then",
                  2.0},
    ParameterText{"lost_ticks", "lost ticks",
                  "share of ticks, at random, on which the controller does not compute and the "
                  "device holds its force; the controller does not know",
                  0.01}};

void draw_skipped_ticks(const PanelContext& context) {
  for (const ParameterText& text : kSkippedRows) {
    const auto& key = key_called<SamplingSettings>(text.key);
    const ParameterRow row = parameter_row("sampling.", key, text, context.session.scene().sampling,
                                           context.scene.loaded.sampling);
    const auto edit = draw_parameter_row(context, row);
    if (!edit) continue;
    change_parameters(context, row.key,
                      [&](Scene& scene) { assign(key, scene.sampling, edit->value); });
  }
}

// A number of the clock, which needs a new session; `usual` is that of a scene without it.
void draw_clock_row(const PanelContext& context, std::string_view name, double usual,
                    const char* tooltip) {
  const auto& key = key_called<SamplingSettings>(name);
  const Scene& scene = context.session.scene();
  const std::string id = fmt::format("sampling.{}", name);
  const auto value =
      number_row(context, {id.c_str(), name, "", tooltip, key.get(scene.sampling).value_or(usual)});
  draw_refusal(context, id.c_str());
  if (!value) return;
  if (key.whole() && *value != std::round(*value))
    return refuse(context, id, fmt::format("{} is no whole number", rounded_number(*value)));
  Scene changed = scene;
  assign(key, changed.sampling, *value == usual ? std::nullopt : value);
  context.scene.wanted = WantedScene{std::move(changed)};
}

// What a real loop does beside the ideal one.
void draw_departures(const PanelContext& context, bool simulated) {
  draw_skipped_ticks(context);
  if (!simulated) return;
  draw_clock_row(
      context, "jitter", 0.0,
      "Periods are independent and uniform within 1 ± jitter of the nominal period, from "
      "0 to 0.99; the controller does not know. Starts a new session.");
  draw_clock_row(context, "seed", 1.0,
                 "Of lost ticks, jitter and noise. A new seed starts a new session.");
}

void set_simulator(const PanelContext& context, const SimulatorSettings& simulator) {
  change_parameters(context, kSubstepsKey, [&](Scene& scene) { scene.simulator = simulator; });
}

void draw_integrator(const PanelContext& context) {
  const SimulatorSettings simulator = context.session.scene().simulator;
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::BeginCombo("##integrator", std::string(simulator.integrator_name()).c_str())) {
    for (const std::string_view name : kIntegratorNames) {
      const bool chosen = name == simulator.integrator_name();
      if (ImGui::Selectable(std::string(name).c_str(), chosen) && !chosen) {
        const Integrator integrator = *find_integrator(name);
        // The exact integrator has no substeps; the others keep the chosen number.
        set_simulator(context,
                      {integrator, integrator == Integrator::kExact ? 1 : simulator.substeps});
      }
    }
    ImGui::EndCombo();
  }
  explain(
      "Integration of the handle between two ticks. The approximate integrators are for "
      "comparison: with one substep, semi-implicit Euler hides a chattering wall. Changes during "
      "the session.");
}

void draw_substeps(const PanelContext& context) {
  const SimulatorSettings simulator = context.session.scene().simulator;
  if (simulator.integrator == Integrator::kExact) return;
  const std::string tooltip =
      fmt::format("Integrator steps per tick, 1 to {}. Changes during the session.", kMaxSubsteps);
  const auto substeps = number_row(context, {"substeps", "substeps", "per tick", tooltip,
                                             static_cast<double>(simulator.substeps)});
  if (substeps && *substeps != std::floor(*substeps)) {
    refuse(context, kSubstepsKey, fmt::format("{} is no whole number", rounded_number(*substeps)));
  } else if (substeps) {
    // Values out of range go to the scene's validation.
    const double within_reach = std::clamp(*substeps, -1.0, kMaxSubsteps + 1.0);
    set_simulator(context, {simulator.integrator, static_cast<int>(within_reach)});
  }
  draw_refusal(context, kSubstepsKey);
}

void draw_estimator_choice(const PanelContext& context) {
  const PartChoice part{
      "estimator", estimators(), estimator_parameters(), &Scene::estimator,
      "Velocity from the measured positions, for the dampers of walls and for the algorithms that "
      "take a velocity. Changes during the session."};
  draw_part_menu(context, part,
                 [](Scene& scene, std::size_t index) { scene.estimator.index = index; });
  draw_part_fields(context, part);
}

// Numbers that follow from the parameters, and the delay of a linear estimator.
void draw_estimator_numbers(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  const Estimator& estimator = estimators()[scene.estimator.index];
  const EstimatorContext settings{scene.sampling.render_rate_hz(),
                                  shown_device(context).encoder_m.value_or(0.0), &scene.estimator};
  if (estimator.numbers != nullptr) {
    for (const DerivedNumber& number : estimator.numbers(settings)) {
      if (number.name.empty()) continue;
      figure_row(context, number.name, fmt::format("{:.6g} {}", number.value, number.unit),
                 draw::Tone::kText, "Follows from the parameters of the estimator.");
    }
  }
  const auto transfer = velocity_transfer(settings);
  figure_row(context, "delay of velocity",
             transfer ? fmt::format("{:.2f} ms", transfer->delay_ticks() / settings.rate_hz *
                                                     kMillisecondsPerSecond)
                      : "by the motion",
             draw::Tone::kText,
             "Age of the velocity in a slow motion. The backward difference has half a tick. A "
             "nonlinear estimator has another delay in each motion.");
}

void draw_cost(const PanelContext& context) {
  const session::TimingStatistics& timing = context.snapshot.timing;
  const bool too_slow = timing.median_cost_s > context.session.scene().sampling.period_s();
  figure_row(context, "cost of a tick", cost_text(timing),
             too_slow ? draw::Tone::kWarning : draw::Tone::kText,
             "Compute time of a tick with simulator, controller and recording: median and maximum "
             "of the last second. If it exceeds the period, the simulation falls behind.");
}

void draw_balance(const PanelContext& context) {
  const PlantTruth& truth = context.snapshot.newest.x().truth;
  figure_row(context, "energy error",
             fmt::format("{:+.1e} of {:.1e} J", energy_error_j(truth),
                         turnover_j(truth.hand_work_j, truth.actuator_work_j, truth.dissipation_j,
                                    truth.kinetic_j)),
             draw::Tone::kText,
             "Energy that the integrator has lost (+) or created (-) since tick 0: the hand's work "
             "minus kinetic energy, dissipation and actuator work. Beside it the turnover, the sum "
             "of the four without their signs.");
}

}  // namespace

std::string cost_text(const session::TimingStatistics& timing) {
  if (timing.cost_ticks == 0) return "–";
  return fmt::format("{:5.1f} µs, max {:4.0f} µs", timing.median_cost_s * kMicrosecondsPerSecond,
                     timing.maximum_cost_s * kMicrosecondsPerSecond);
}

double energy_error_j(const PlantTruth& truth) {
  return truth.hand_work_j - (truth.kinetic_j + truth.dissipation_j + truth.actuator_work_j);
}

void draw_loop_section(const PanelContext& context) {
  const AskedFor asked = asked_for(context);
  section(context, "Loop", asked.simulator || asked.estimator);
  draw_rate(context);
  const bool simulated = context.session.device_info().is_simulated;
  if (simulated) {
    draw_integrator(context);
    draw_substeps(context);
  }
  draw_departures(context, simulated);
  draw_estimator_choice(context);
  draw_estimator_numbers(context);
  if (context.can.timing) draw_cost(context);
  if (simulated) draw_balance(context);
}

}  // namespace hapticwall::ui
