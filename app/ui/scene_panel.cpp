// Scene and sampling: what needs a new session.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "app/file/scene_file.h"
#include "app/ui/control_panel.h"
#include "app/ui/widgets.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

struct PaperFigure {
  const char* label;
  const char* algorithm;
  PlotArrangement arrangement;
  const char* tooltip;
};
constexpr const char* kPaperScene = "press";
constexpr std::array kPaperFigures{
    PaperFigure{
        "Figure 4", "none", PlotArrangement::kFigure4,
        "The paper's Figure 4: the wall without a stabilising algorithm. Starts scene 'press' from "
        "rest and shows position, force and the passivity observer, which stays positive although "
        "the contact never comes to rest."},
    PaperFigure{"Figure 5", "virtual-coupling", PlotArrangement::kFigure5And6,
                "The paper's Figure 5: virtual coupling. Starts scene 'press' from rest and shows "
                "position, "
                "force and stiffness: quiet, and soft."},
    PaperFigure{
        "Figure 6", "energy-bounding", PlotArrangement::kFigure5And6,
        "The paper's Figure 6: the energy bounding algorithm. Starts scene 'press' from rest and "
        "shows position, force and stiffness: quiet, and stiff."}};

// Asks for a built-in scene, with its own algorithm or the one named.
void want_builtin(const PanelContext& context, const std::string& name,
                  std::string_view algorithm) {
  Result<file::LoadedScene> loaded = file::load_scene(name);
  if (!loaded) {
    tell(context.state, MessageKind::kProblem, loaded.error().message);
    return;
  }
  Scene scene = std::move(loaded->scene);
  if (!algorithm.empty()) {
    const auto index = find_algorithm(algorithm);
    if (!index) return;
    scene.algorithm.index = *index;
  }
  context.state.transient.wanted_scene = std::move(scene);
}

void draw_figure_buttons(const PanelContext& context) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const auto count = static_cast<float>(kPaperFigures.size());
  const float width = (ImGui::GetContentRegionAvail().x - (count - 1.0F) * gap) / count;
  for (const PaperFigure& figure : kPaperFigures) {
    if (&figure != kPaperFigures.data()) ImGui::SameLine();
    if (ImGui::Button(figure.label, ImVec2(width, 0.0F))) {
      want_builtin(context, kPaperScene, figure.algorithm);
      context.state.persisted.arrangement = figure.arrangement;
    }
    remember_item(context.state, figure.label);
    explain(figure.tooltip);
  }
}

}  // namespace

void draw_scene_section(const PanelContext& context) {
  section(context, "Scene");
  const Scene& scene = context.session.scene();
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::BeginCombo("##scene", scene.name.c_str())) {
    for (const file::BuiltinScene& builtin : file::builtin_scenes()) {
      if (ImGui::Selectable(builtin.name.c_str(), builtin.name == scene.name)) {
        want_builtin(context, builtin.name, {});
      }
      explain(builtin.description);
    }
    ImGui::EndCombo();
  }
  remember_item(context.state, "scene");
  explain("A built-in scene starts a new session, at rest.");
  if (!scene.description.empty()) muted_text(context, scene.description);
  draw_figure_buttons(context);
}

namespace {

void draw_rate(const PanelContext& context) {
  field_label(
      context, "sampling rate",
      "Ticks of the real-time loop a second, 100 Hz to 10 kHz. A new rate starts a new session, at "
      "rest.",
      "Hz");
  const Scene& scene = context.session.scene();
  const auto rate_hz = number_field(context, "##rate", scene.sampling.rate_hz);
  remember_item(context.state, "rate");
  unit_label("Hz");
  if (!rate_hz) return;
  Scene changed = scene;
  changed.sampling.rate_hz = *rate_hz;
  context.state.transient.wanted_scene = std::move(changed);
}

void want_simulator(const PanelContext& context, const SimulatorSettings& simulator) {
  Scene changed = context.session.scene();
  changed.simulator = simulator;
  context.state.transient.wanted_scene = std::move(changed);
}

void draw_integrator(const PanelContext& context) {
  const SimulatorSettings& simulator = context.session.scene().simulator;
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::BeginCombo("##integrator", std::string(simulator.integrator_name()).c_str())) {
    for (const std::string_view name : kIntegratorNames) {
      const bool chosen = name == simulator.integrator_name();
      if (ImGui::Selectable(std::string(name).c_str(), chosen) && !chosen) {
        want_simulator(context, {*find_integrator(name), 1});
      }
      remember_item(context.state, name);
    }
    ImGui::EndCombo();
  }
  remember_item(context.state, "integrator");
  explain(
      "How the simulator moves the handle between two ticks. The others show what a simulator that "
      "uses them would have shown: at one substep semi-implicit Euler hides a chattering wall. A "
      "new choice starts a new session, at rest.");
}

void draw_substeps(const PanelContext& context) {
  const SimulatorSettings& simulator = context.session.scene().simulator;
  if (simulator.integrator == Integrator::kExact) return;
  field_label(context, "substeps", "Steps of the integrator in a tick, 1 to 1000.", "per tick");
  const auto substeps =
      number_field(context, "##substeps", static_cast<double>(simulator.substeps));
  remember_item(context.state, "substeps");
  unit_label("per tick");
  if (!substeps) return;
  // What is not a whole number in range is for the scene's own check to say.
  const double whole = std::clamp(std::floor(*substeps), -1.0, kMaximumSubsteps + 1.0);
  want_simulator(context, {simulator.integrator, static_cast<int>(whole)});
}

// What the integrator has lost or made so far: hand work less kinetic energy, losses and actuator
// work.
void draw_balance(const PanelContext& context) {
  const PlantTruth& truth = context.snapshot.sample.truth;
  const double error_j =
      truth.hand_work_j - (truth.kinetic_j + truth.dissipation_j + truth.actuator_work_j);
  muted_text(context, fmt::format("Energy balance off by {:.1e} J", error_j));
}

}  // namespace

void draw_loop_section(const PanelContext& context) {
  section(context, "Loop");
  draw_rate(context);
  draw_integrator(context);
  draw_substeps(context);
  draw_balance(context);
}

}  // namespace hapticwall::ui
