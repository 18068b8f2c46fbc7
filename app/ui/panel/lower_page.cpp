#include "app/ui/lower_page.h"

#include <array>
#include <string>

#include "app/ui/blind_test.h"
#include "app/ui/blind_test_page.h"
#include "app/ui/energy_lamp_view.h"
#include "app/ui/ghosts.h"
#include "app/ui/plots_panel.h"
#include "app/ui/timing_page.h"
#include "app/ui/widgets.h"

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
    Page{LowerPage::kTiming, "Timing", "How the loop and the window keep their time"},
    Page{LowerPage::kBlindTest, "Blind test",
         "Which of two walls? A and B of Compare, felt in an order that nobody sees"}};

void draw_page_choice(const PanelContext& context) {
  const LowerPage now = lower_page(context.state);
  ImGui::BeginDisabled(blind_test_runs(context.state));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(1.0F, ImGui::GetStyle().ItemSpacing.y));
  for (const Page& page : kPages) {
    if (choice_button(context, page.name, now == page.page))
      context.state.persisted.lower_page = page.page;
    remember_item(context.state, std::string("page ") + page.name);
    explain(blind_test_runs(context.state) ? "Hidden until the blind test ends" : page.meaning);
    ImGui::SameLine();
  }
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
}

}  // namespace

LowerPage lower_page(const UiState& state) {
  return blind_test_runs(state) ? LowerPage::kBlindTest : state.persisted.lower_page;
}

void draw_lower_page(const PanelContext& context, const SampleHistory& history) {
  draw_page_choice(context);
  ImGui::SameLine(0.0F, kTabGapEms * ImGui::GetFontSize());
  draw_energy_lamp(context);
  ImGui::BeginChild("lower page", ImVec2(0.0F, 0.0F), ImGuiChildFlags_Borders);
  switch (lower_page(context.state)) {
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
  }
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
