#include "app/ui/window/window_layout.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/first/presentation.h"
#include "app/ui/panel/arming_strip.h"
#include "app/ui/panel/energy_lamp_view.h"
#include "app/ui/panel/layout_choice.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/toasts.h"
#include "app/ui/widget/widgets.h"
#include "app/ui/window/dock_nodes.h"
#include "app/ui/window/help_overlay.h"

namespace hapticwall::ui {
namespace {

constexpr float kLayoutEms = 8.5F;
constexpr float kLampGapEms = 1.2F;
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

// Rows, dock area and foot.
void draw_docked(const PageParts& parts) {
  const PanelContext& context = parts.context;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float foot = draw::kSmallFontSize * style.FontScaleMain + 2.0F * style.ItemSpacing.y;
  draw_top(context);
  const ImVec2 free = ImGui::GetContentRegionAvail();
  draw_dock(parts, ImVec2(free.x, std::max(1.0F, free.y - foot)));
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  draw_foot(context);
}

}  // namespace

void draw_window(const FirstParts& parts) {
  const PanelContext& context = parts.page.context;
  share_arrows(true);
  keep_presentation(context);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
      ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoDocking |
      ImGuiWindowFlags_NoBackground;  // the window is cleared to it
  const ImGuiStyle& style = ImGui::GetStyle();
  const bool first = shows_first_window(context);
  const float padding = (first ? 2.0F : 1.0F) * style.ItemSpacing.x;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(padding, padding));
  ImGui::Begin("Haptic Wall", nullptr, kFlags);
  ImGui::PopStyleVar();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  if (first) {
    draw_first_window(parts);
  } else {
    draw_docked(parts.page);
  }
  ImGui::End();
  const float foot = draw::kSmallFontSize * style.FontScaleMain + 2.0F * style.ItemSpacing.y;
  draw_over_everything(context, ImVec2(corner.x + free.x, corner.y + free.y - foot));
}

}  // namespace hapticwall::ui
