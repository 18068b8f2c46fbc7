#include "app/ui/page/lower_page.h"

#include <fmt/format.h>

#include <array>

#include "app/ui/page/all_page.h"
#include "app/ui/page/blind_test_page.h"
#include "app/ui/page/map_page.h"
#include "app/ui/page/plots_panel.h"
#include "app/ui/page/study_page.h"
#include "app/ui/page/timing_page.h"
#include "app/ui/panel/energy_lamp_view.h"
#include "app/ui/panel/verdict_strip.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kTabGapEms = 1.2F;  // before the lamp

struct Page {
  LowerPage page;
  const char* name;
  const char* meaning;
};
constexpr std::array kPages{
    Page{LowerPage::kPlots, "Plots", "Position, force, stiffness and energy over time"},
    Page{LowerPage::kTiming, "Timing", "Timing of the loop and of the window"},
    Page{LowerPage::kBlindTest, "Blind test",
         "Which of two walls? A and B of Compare, in hidden order"},
    Page{LowerPage::kMap, "Map",
         "Where the present scene is stable, over two of its numbers. A click makes a cell the "
         "running scene."},
    Page{LowerPage::kAll, "All at once",
         "The present scene under all algorithms. A click puts one in force."},
    Page{LowerPage::kStudy, "Study",
         "Tables of the present scene: the algorithms ranked, the integrators measured"}};

void draw_page_choice(const PanelContext& context) {
  const LowerPage now = lower_page(context);
  ImGui::BeginDisabled(context.shows.hides_force);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(1.0F, ImGui::GetStyle().ItemSpacing.y));
  for (const Page& page : kPages) {
    if (choice_button(
            context, fmt::format("{0}###page {0}", page.name), now == page.page,
            context.shows.hides_force ? "Hidden until the blind test ends" : page.meaning))
      context.state.persisted.lower_page = page.page;
    ImGui::SameLine();
  }
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
}

}  // namespace

LowerPage lower_page(const PanelContext& context) {
  if (context.shows.hides_force) return LowerPage::kBlindTest;
  return context.state.persisted.more ? context.state.persisted.lower_page : LowerPage::kPlots;
}

void draw_lower_page(const PanelContext& context, const draw::SampleHistory& history) {
  if (context.state.persisted.more) {
    draw_page_choice(context);
    ImGui::SameLine(0.0F, kTabGapEms * ImGui::GetFontSize());
  }
  draw_energy_lamp(context);
  draw_verdict_strip(context);
  if (lower_page(context) != LowerPage::kMap) context.state.map.live.stop();
  if (lower_page(context) != LowerPage::kAll) context.state.all_runs.stop();
  if (lower_page(context) != LowerPage::kStudy) context.state.studies.stop();
  ImGui::BeginChild("lower page", ImVec2(0.0F, 0.0F),
                    ImGuiChildFlags_Borders | ImGuiChildFlags_NavFlattened);
  switch (lower_page(context)) {
    case LowerPage::kPlots:
      show_ghost(context);
      draw_plots_panel(context, history);
      break;
    case LowerPage::kTiming:
      draw_timing_page(context);
      break;
    case LowerPage::kBlindTest:
      draw_blind_test_page(context);
      break;
    case LowerPage::kMap:
      draw_map_page(context);
      break;
    case LowerPage::kAll:
      draw_all_page(context);
      break;
    case LowerPage::kStudy:
      draw_study_page(context);
      break;
  }
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
