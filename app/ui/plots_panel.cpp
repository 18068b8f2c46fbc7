#include "app/ui/plots_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr std::array kTimeWindowsS{0.5, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0};
static_assert(kTimeWindowsS.front() == kShortestTimeWindowS &&
              kTimeWindowsS.back() == kLongestTimeWindowS);
constexpr double kAxisMovedS = 1e-9;  // what is not a rounding error

constexpr std::array kAllPlots{PlotId::kPosition, PlotId::kForce, PlotId::kStiffness,
                               PlotId::kPassivity};
constexpr std::array kFigure4Plots{PlotId::kPosition, PlotId::kForce, PlotId::kPassivity};
constexpr std::array kFigure5And6Plots{PlotId::kPosition, PlotId::kForce, PlotId::kStiffness};

std::span<const PlotId> plots_of(PlotArrangement arrangement) {
  switch (arrangement) {
    case PlotArrangement::kFigure4:
      return kFigure4Plots;
    case PlotArrangement::kFigure5And6:
      return kFigure5And6Plots;
    case PlotArrangement::kAll:
      break;
  }
  return kAllPlots;
}

void draw_arrangement(const PanelContext& context) {
  PlotArrangement& arrangement = context.state.persisted.arrangement;
  const auto choice = [&](const char* label, PlotArrangement value, const char* tooltip) {
    if (choice_button(context, label, arrangement == value)) arrangement = value;
    remember_item(context.state, label);
    explain(tooltip);
    ImGui::SameLine();
  };
  choice("all plots", PlotArrangement::kAll, "Position, force, stiffness and passivity");
  choice("as Figure 4", PlotArrangement::kFigure4,
         "The panels of the paper's Figure 4: position, force, passivity");
  choice("as Figures 5, 6", PlotArrangement::kFigure5And6,
         "The panels of the paper's Figures 5 and 6: position, force, stiffness");
}

void draw_time_window(const PanelContext& context) {
  TransientState& transient = context.state.transient;
  double& window_s = context.state.persisted.time_window_s;
  const float em = ImGui::GetFontSize();
  const float width = 17.0F * em;
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetContentRegionMax().x - width));
  ImGui::BeginDisabled(transient.follow);
  if (ImGui::Button("Follow")) transient.follow = true;
  ImGui::EndDisabled();
  remember_item(context.state, "follow");
  explain(transient.follow
              ? "The plots follow the newest samples. Drag or scroll in a plot to look closer."
              : "Back to the newest samples");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("newest");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::BeginCombo("##window", fmt::format("{:g} s", window_s).c_str())) {
    for (const double choice_s : kTimeWindowsS) {
      if (!ImGui::Selectable(fmt::format("{:g} s", choice_s).c_str(), choice_s == window_s))
        continue;
      window_s = choice_s;
      transient.follow = true;
    }
    ImGui::EndCombo();
  }
  remember_item(context.state, "time window");
}

}  // namespace

void follow_newest(UiState& state, double newest_time_s) {
  const double window_s =
      std::clamp(state.persisted.time_window_s, kShortestTimeWindowS, kLongestTimeWindowS);
  state.transient.time_to_s = std::max(newest_time_s, window_s);
  state.transient.time_from_s = state.transient.time_to_s - window_s;
}

void draw_plots_panel(const PanelContext& context, const SampleHistory& history) {
  TransientState& transient = context.state.transient;
  draw_arrangement(context);
  draw_time_window(context);
  if (transient.follow) follow_newest(context.state, history.newest_time_s());
  const double from_s = transient.time_from_s;
  const double to_s = transient.time_to_s;
  PlotSurface surface{&context.theme,
                      &history,
                      context.session.scene().walls,
                      &transient.time_from_s,
                      &transient.time_to_s,
                      &context.state.persisted.hidden_lines,
                      &transient.scratch,
                      transient.follow,
                      true,
                      kLineWeight * ImGui::GetStyle().FontScaleMain};

  const std::span<const PlotId> plots = plots_of(context.state.persisted.arrangement);
  // Four make a square; the paper's three stand in a column, as on its pages.
  const std::size_t columns = plots.size() == kAllPlots.size() ? 2 : 1;
  const std::size_t whole_rows = (plots.size() + columns - 1) / columns;
  const auto rows = static_cast<float>(whole_rows);
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const ImVec2 gap(1.6F * ImGui::GetFontSize(), ImGui::GetStyle().ItemSpacing.y);
  const auto count = static_cast<float>(columns);
  const ImVec2 each((free.x - (count - 1.0F) * gap.x) / count,
                    (free.y - (rows - 1.0F) * gap.y) / rows);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const auto column = static_cast<float>(i % columns);
    const std::size_t row_index = i / columns;
    const auto row = static_cast<float>(row_index);
    ImGui::SetCursorScreenPos(
        ImVec2(corner.x + column * (each.x + gap.x), corner.y + row * (each.y + gap.y)));
    const std::string mark = columns == 1 ? fmt::format("({}) ", static_cast<char>('a' + i)) : "";
    const PlotDescription& plot = plot_description(plots[i]);
    surface.time_labels = i + columns >= plots.size();  // linked axes need them once
    const PlotArea area = draw_plot(surface, plot, mark, each);
    transient.items.insert_or_assign(
        std::string("plot ") + plot.title,
        ItemRect{area.position,
                 ImVec2(area.position.x + area.size.x, area.position.y + area.size.y)});
  }
  // Whoever drags an axis wants to look, not to follow.
  if (std::abs(transient.time_from_s - from_s) > kAxisMovedS ||
      std::abs(transient.time_to_s - to_s) > kAxisMovedS) {
    transient.follow = false;
  }
}

}  // namespace hapticwall::ui
