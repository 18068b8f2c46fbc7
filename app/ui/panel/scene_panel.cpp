#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/recent_files.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

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
                "position, force and stiffness: quiet, and soft."},
    PaperFigure{
        "Figure 6", "energy-bounding", PlotArrangement::kFigure5And6,
        "The paper's Figure 6: the energy bounding algorithm. Starts scene 'press' from rest and "
        "shows position, force and stiffness: quiet, and stiff."}};

void draw_figure_buttons(const PanelContext& context) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const auto count = static_cast<float>(kPaperFigures.size());
  const float width = (ImGui::GetContentRegionAvail().x - (count - 1.0F) * gap) / count;
  for (const PaperFigure& figure : kPaperFigures) {
    if (&figure != kPaperFigures.data()) ImGui::SameLine();
    if (!button(figure.label, figure.tooltip, {.width = width})) continue;
    want_builtin(context, kPaperScene, figure.algorithm);
    context.plots.persisted.arrangement = figure.arrangement;
  }
}

// The figures of the paper have a layout each.
bool shows_paper(const PanelContext& context) {
  const PlotArrangement arrangement = context.plots.persisted.arrangement;
  return context.window.more &&
         (arrangement == PlotArrangement::kFigure4 || arrangement == PlotArrangement::kFigure5And6);
}

// Stands beside the heading, so that nothing moves when it appears.
void draw_way_back(const PanelContext& context) {
  if (context.shows.live == nullptr) return;
  const Scene& loaded = context.scene.loaded;
  const std::vector<std::string> changed = changed_values(context.session.scene(), loaded);
  if (changed.empty()) return;
  const std::string label = fmt::format("Reset to scene ({})###reset to scene", changed.size());
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x -
                  button_width(label.c_str()));
  const bool clicked = ImGui::SmallButton(label.c_str());
  ImGui::PopFont();
  explain(
      fmt::format("Restores the scene's values during the session:\n{}", fmt::join(changed, "\n")));
  if (!clicked) return;
  context.edit.refusal.reset();
  const Scene back = with_loaded_values(context.session.scene(), loaded);
  if (const auto problem = ask_for(context, back)) tell(context.toasts, *problem);
}

void draw_builtin_choices(const PanelContext& context) {
  const std::string& current = context.session.scene().name;
  for (const file::BuiltinScene& builtin : file::builtin_scenes()) {
    if (list_choice(fmt::format("{0}###scene {0}", builtin.name), builtin.name == current,
                    builtin.description))
      want_builtin(context, builtin.name, {});
  }
}

void draw_recent_choices(const PanelContext& context) {
  std::string chosen;
  const std::vector<std::string>& recent = context.scene.recent;
  if (!recent.empty()) {
    ImGui::Separator();
    ImGui::TextDisabled("Opened before");
  }
  for (std::size_t i = 0; i < recent.size(); ++i) {
    const std::string name = std::filesystem::path(recent[i]).filename().string();
    if (list_choice(fmt::format("{}###recent {}", name, i + 1), false, recent[i]))
      chosen = recent[i];
  }
  if (!chosen.empty()) open_file(context.scene, context.toasts, chosen);
}

void draw_path_field(const PanelContext& context) {
  ImGui::Separator();
  ImGui::SetNextItemWidth(-1.0F);
  const auto path = text_field(context, "##open path", "path of a scene or a recording", "");
  explain(
      "Opens this file: a scene (.toml) or a recording (.csv). A file can also be dragged onto "
      "the window.");
  if (!path || path->empty()) return;
  open_file(context.scene, context.toasts, *path);
  ImGui::CloseCurrentPopup();
}

}  // namespace

void want_builtin(const PanelContext& context, std::string_view name, std::string_view algorithm) {
  Result<file::LoadedScene> loaded = file::load_scene(std::string(name));
  if (!loaded) return tell(context.toasts, loaded.error());
  Scene scene = std::move(loaded->scene);
  if (!algorithm.empty()) {
    const auto index = find_algorithm(algorithm);
    if (!index) return;
    scene.algorithm.index = *index;
  }
  context.scene.wanted = WantedScene{std::move(scene), true};
}

void draw_scene_section(const PanelContext& context) {
  section(context, "Scene");
  draw_way_back(context);
  const Scene& scene = context.session.scene();
  ImGui::SetNextItemWidth(-1.0F);
  const bool open = ImGui::BeginCombo("##scene", scene.name.c_str(), ImGuiComboFlags_HeightLargest);
  if (open) {
    draw_builtin_choices(context);
    if (context.can.files) {
      draw_recent_choices(context);
      draw_path_field(context);
    }
    ImGui::EndCombo();
  }
  explain("A scene starts a new session from rest.");
  if (!scene.description.empty()) muted_text(context, scene.description);
  if (shows_paper(context)) draw_figure_buttons(context);
}

}  // namespace hapticwall::ui
