#include "app/ui/page/pages.h"
#include "app/ui/panel/identify_state.h"
#include "app/ui/panel/loop_panel.h"
#include "app/ui/panel/replay_panel.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kLockedAlpha = 0.7F;  // opacity of values that cannot change

// Values that the loop has not echoed yet are dimmed.
void draw_dimmed(const PanelContext& context, bool dimmed, void (*draw)(const PanelContext&)) {
  if (dimmed) ImGui::PushStyleColor(ImGuiCol_Text, context.theme.colour(draw::Tone::kMuted));
  draw(context);
  if (dimmed) ImGui::PopStyleColor();
}

void draw_more_sections(const PanelContext& context) {
  const AskedFor asked = asked_for(context);
  draw_dimmed(context, asked.algorithm, draw_compare_section);
  draw_dimmed(context, asked.walls, draw_wall_section);
  draw_dimmed(context, asked.hand, draw_hand_section);
  draw_dimmed(context, asked.device, draw_device_section);
  draw_dimmed(context, asked.simulator, draw_loop_section);
}

}  // namespace

void draw_controls_page(const PanelContext& context) {
  draw_panel_head(context);
  if (context.shows.hides_algorithm) {
    muted_text(
        context,
        "A blind test runs. This panel would reveal the order of the two walls; it comes back "
        "when the test ends.");
    return;
  }
  draw_scene_section(context);
  session::ReplaySession* replay = context.shows.replay;
  if (replay != nullptr) draw_replay_section(context, *replay);
  ImGui::PushStyleVar(ImGuiStyleVar_DisabledAlpha, kLockedAlpha);
  ImGui::BeginDisabled(replay != nullptr || context.identify.experiment);
  draw_dimmed(context, asked_for(context).algorithm, draw_algorithm_section);
  if (context.window.more) {
    draw_more_sections(context);
  } else {
    const bool wanted =
        button("More###more",
               "Every parameter, comparison, pages and plot controls. Settings, layout, brings "
               "back what is shown now.",
               {.width = ImGui::GetContentRegionAvail().x});
    point_at(context, TourPlace::kMore);
    if (wanted) show_more(context.window, context.plots);
  }
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
}

}  // namespace hapticwall::ui
