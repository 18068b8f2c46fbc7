#include "app/ui/window/window_layout.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/computed/tail.h"
#include "app/ui/panel/arming_strip.h"
#include "app/ui/panel/energy_lamp_view.h"
#include "app/ui/panel/layout_choice.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/toasts.h"
#include "app/ui/widget/widgets.h"
#include "app/ui/window/dock_nodes.h"
#include "app/ui/window/help_overlay.h"

namespace hapticwall::ui {
namespace {

constexpr float kLayoutEms = 8.5F;
constexpr float kLampGapEms = 1.2F;
constexpr const char* kVerdictMeaning =
    "The last second, with the formulas of 'hapticwall run': verdict, peak-to-peak motion of the "
    "handle, mean force and its standard deviation, mean force over mean penetration, and the "
    "frequency of what shakes. Chatter is what the force does within 50 ms beyond a straight line, "
    "at least 0.2 s after a touch. Above 0.3 N, or a tenth of the force limit, the wall is "
    "buzzing, "
    "or oscillating if the handle swings by more than 0.1 mm. Otherwise the handle rests (settled) "
    "or moves (moving), and a wall that gives the hand more than 5 mW is called active.";

// The verdict of the last second on the shown axis. Neutral during a blind test.
void draw_verdict(const PanelContext& context) {
  if (context.shows.hides_force) {
    ImGui::TextDisabled("verdict: hidden");
    return;
  }
  const Tail& tail = context.tails.at(shown_index(context));
  const std::string text = tail_text(tail);
  {
    const draw::FontScope font(context.theme.fonts.digits, draw::kTitleFontSize);
    const float share = ImGui::GetContentRegionAvail().x / ImGui::CalcTextSize(text.c_str()).x;
    const draw::FontScope fitting(context.theme.fonts.digits,
                                  std::clamp(std::floor(share * draw::kTitleFontSize),
                                             draw::kSmallFontSize, draw::kTitleFontSize));
    draw::wrapped_text(context.theme.colour(draw::verdict_tone(tail.summary.verdict)), text);
  }
  explain(kVerdictMeaning);
}

// The rows above the dock area.
void draw_top(const PanelContext& context) {
  draw_arming_strip(context);
  draw_toolbar(context);
  draw_tour_strip(context);
  if (context.window.more && !context.shows.hides_algorithm) {
    ImGui::SetNextItemWidth(ems(kLayoutEms));
    draw_layout_choice(context);
    ImGui::SameLine(0.0F, ems(kLampGapEms));
  }
  draw_energy_lamp(context);
  draw_verdict(context);
}

// The messages are above the status, at the right edge.
void draw_over_everything(const PanelContext& context, ImVec2 lower_right) {
  draw_help(context);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  draw_toasts(context, lower_right.x - gap, lower_right.y - gap);
}

}  // namespace

void draw_window(const PageParts& parts) {
  const PanelContext& context = parts.context;
  share_arrows(true);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
      ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoDocking |
      ImGuiWindowFlags_NoBackground;  // the window is cleared to it
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(style.ItemSpacing.x, style.ItemSpacing.x));
  ImGui::Begin("Haptic Wall", nullptr, kFlags);
  ImGui::PopStyleVar();
  const float status_height =
      2.0F * (draw::kSmallFontSize * style.FontScaleMain + style.ItemSpacing.y) +
      style.ItemSpacing.y;
  draw_top(context);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float height = std::max(1.0F, free.y - status_height);
  draw_dock(parts, ImVec2(free.x, height));
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  draw_hint_row(context);
  draw_status_row(context);
  ImGui::PopFont();
  ImGui::End();
  draw_over_everything(context, ImVec2(corner.x + free.x, corner.y + height));
}

}  // namespace hapticwall::ui
