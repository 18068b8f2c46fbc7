#include "app/ui/window_layout.h"

#include <algorithm>
#include <cmath>

#include "app/ui/arming_strip.h"
#include "app/ui/blind_test.h"
#include "app/ui/control_panel.h"
#include "app/ui/help_overlay.h"
#include "app/ui/lower_page.h"
#include "app/ui/magnifier.h"
#include "app/ui/panel_head.h"
#include "app/ui/replay_panel.h"
#include "app/ui/replay_state.h"
#include "app/ui/splitter.h"
#include "app/ui/status_line.h"
#include "app/ui/toasts.h"
#include "app/ui/toolbar.h"
#include "app/ui/wall_view.h"
#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kNarrowestPanelEms = 14.0F;
constexpr float kLockedAlpha = 0.7F;       // of what was recorded and does not change
constexpr float kWidestPanelShare = 0.5F;  // of the window

float panel_width(const PanelContext& context, float window_width) {
  const float wanted = static_cast<float>(context.state.persisted.panel_ems) * ImGui::GetFontSize();
  const float most = kWidestPanelShare * window_width;
  return std::floor(
      std::clamp(wanted, std::min(kNarrowestPanelEms * ImGui::GetFontSize(), most), most));
}

void draw_panel(const PanelContext& context, float width, float height) {
  ImGui::BeginChild("controls", ImVec2(width, height), ImGuiChildFlags_Borders);
  draw_panel_head(context);
  if (blind_test_runs(context.state)) {
    muted_text(context,
               "A blind test runs. What stands here at other times would give the order of the two "
               "walls away; it comes back when the test ends.");
    ImGui::EndChild();
    return;
  }
  draw_scene_section(context);
  runtime::ReplaySession* replay = replay_of(context.session);
  if (replay != nullptr) draw_replay_section(context, *replay);
  ImGui::PushStyleVar(ImGuiStyleVar_DisabledAlpha, kLockedAlpha);
  ImGui::BeginDisabled(replay != nullptr);
  draw_algorithm_section(context);
  draw_compare_section(context);
  draw_wall_section(context);
  draw_hand_section(context);
  draw_device_section(context);
  draw_loop_section(context);
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void move_panel(const PanelContext& context, float width, const Split& split) {
  double& ems = context.state.persisted.panel_ems;
  if (split.moved != 0.0F) {
    ems = std::max(static_cast<double>((width + split.moved) / ImGui::GetFontSize()),
                   static_cast<double>(kNarrowestPanelEms));
  }
  if (split.reset) ems = PersistedState{}.panel_ems;
}

// Pixels of the wall's picture, as the scene is first shown, for a metre at the contact.
double view_scale(const PanelContext& context, ImVec2 size) {
  constexpr double kProbeM = 1e-3;
  const Scene& scene = context.session.scene();
  if (scene.walls.empty()) return 1.0;
  const WallCamera camera = wall_view_camera(scene, size);
  const double face_m = scene.walls.front().position_m;
  const glm::vec2 face = camera.pixel_of({camera.x_of(face_m), 0.0F, 0.0F});
  const glm::vec2 beside = camera.pixel_of({camera.x_of(face_m + kProbeM), 0.0F, 0.0F});
  return static_cast<double>(glm::distance(face, beside)) / kProbeM;
}

void draw_views(const PanelContext& context, const SampleHistory& history, WallRenderer& renderer,
                ImVec2 size) {
  constexpr ImGuiWindowFlags kStill =
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  double& share = context.state.persisted.picture_share;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::BeginChild("views", size, ImGuiChildFlags_None, ImGuiWindowFlags_NoBackground | kStill);
  const float width = std::floor(static_cast<float>(share) * size.x);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(1.0F, 1.0F));
  ImGui::BeginChild("wall", ImVec2(width, 0.0F), ImGuiChildFlags_Borders, kStill);
  ImGui::PopStyleVar();
  const double pixels_per_m = view_scale(context, ImGui::GetContentRegionAvail());
  draw_wall_view(context, renderer);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("contact", ImVec2(0.0F, 0.0F), ImGuiChildFlags_Borders, kStill);
  draw_magnifier(context, history, pixels_per_m);
  ImGui::EndChild();
  const Split split = draw_splitter(context, "picture splitter", SplitWay::kColumns,
                                    ImVec2(corner.x + width, corner.y), size.y);
  move_share(share, split, size.x, PersistedState{}.picture_share);
  ImGui::EndChild();
}

void draw_right(const PanelContext& context, const SampleHistory& history, WallRenderer& renderer,
                float height) {
  double& share = context.state.persisted.view_share;
  ImGui::BeginChild("right", ImVec2(0.0F, height), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_arming_strip(context);
  draw_toolbar(context);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const ImVec2 views(free.x, std::floor(static_cast<float>(share) * free.y));
  draw_views(context, history, renderer, views);
  draw_lower_page(context, history);
  const Split split = draw_splitter(context, "view splitter", SplitWay::kRows,
                                    ImVec2(corner.x, corner.y + views.y), free.x);
  move_share(share, split, free.y, PersistedState{}.view_share);
  ImGui::EndChild();
}

// Where the messages stand: above the status, at the right edge.
void draw_over_everything(const PanelContext& context, ImVec2 lower_right) {
  draw_help(context);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  draw_toasts(context, lower_right.x - gap, lower_right.y - gap);
}

}  // namespace

void draw_window(const PanelContext& context, const SampleHistory& history,
                 WallRenderer& renderer) {
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoScrollWithMouse |
                                      ImGuiWindowFlags_NoBackground;  // the window is cleared to it
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(style.ItemSpacing.x, style.ItemSpacing.x));
  ImGui::Begin("Haptic Wall", nullptr, kFlags);
  ImGui::PopStyleVar();
  const float status_height =
      2.0F * (kSmallFontSize * style.FontScaleMain + style.ItemSpacing.y) + style.ItemSpacing.y;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float height = std::max(1.0F, free.y - status_height);
  const float width = panel_width(context, free.x);
  draw_panel(context, width, height);
  ImGui::SameLine();
  draw_right(context, history, renderer, height);
  move_panel(context, width,
             draw_splitter(context, "panel splitter", SplitWay::kColumns,
                           ImVec2(corner.x + width, corner.y), height));
  ImGui::PushFont(nullptr, kSmallFontSize);
  draw_hint_row(context);
  draw_status_row(context);
  ImGui::PopFont();
  ImGui::End();
  draw_over_everything(context, ImVec2(corner.x + free.x, corner.y + height));
}

}  // namespace hapticwall::ui
