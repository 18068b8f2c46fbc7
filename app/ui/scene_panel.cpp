// Scene and sampling: what needs a new session.
#include <fmt/format.h>

#include <algorithm>
#include <array>

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

void draw_loop_section(const PanelContext& context) {
  section(context, "Loop");
  const Scene& scene = context.session.scene();
  field_label(
      context, "sampling rate",
      "Ticks of the real-time loop a second, 100 Hz to 10 kHz. A new rate starts a new session, at "
      "rest.",
      "Hz");
  const auto rate_hz = number_field(context, "##rate", scene.sampling.rate_hz);
  remember_item(context.state, "rate");
  unit_label("Hz");
  if (!rate_hz) return;
  Scene changed = scene;
  changed.sampling.rate_hz = *rate_hz;
  context.state.transient.wanted_scene = std::move(changed);
}

}  // namespace hapticwall::ui
