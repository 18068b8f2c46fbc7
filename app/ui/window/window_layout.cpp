#include "app/ui/window/window_layout.h"

#include <algorithm>
#include <cmath>

#include "app/ui/page/lower_page.h"
#include "app/ui/page/magnifier.h"
#include "app/ui/panel/arming_strip.h"
#include "app/ui/panel/loop_panel.h"
#include "app/ui/panel/replay_panel.h"
#include "app/ui/panel/sections.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/panel/wall_view.h"
#include "app/ui/state/changes.h"
#include "app/ui/widget/splitter.h"
#include "app/ui/widget/toasts.h"
#include "app/ui/widget/widgets.h"
#include "app/ui/window/help_overlay.h"

namespace hapticwall::ui {
namespace {

constexpr float kMinPanelWidthEms = 14.0F;
constexpr float kLockedAlpha = 0.7F;    // of values that cannot change
constexpr float kMaxPanelShare = 0.5F;  // of the window
constexpr ImGuiWindowFlags kStill =
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;

float panel_width(const PanelContext& context, float window_width) {
  const float wanted = static_cast<float>(context.state.persisted.panel_ems) * ImGui::GetFontSize();
  const float most = kMaxPanelShare * window_width;
  return std::floor(
      std::clamp(wanted, std::min(kMinPanelWidthEms * ImGui::GetFontSize(), most), most));
}

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

void draw_panel(const PanelContext& context, float width, float height) {
  ImGui::BeginChild("controls", ImVec2(width, height),
                    ImGuiChildFlags_Borders | ImGuiChildFlags_NavFlattened);
  draw_panel_head(context);
  if (context.shows.hides_algorithm) {
    muted_text(
        context,
        "A blind test runs. This panel would reveal the order of the two walls; it comes back "
        "when the test ends.");
    ImGui::EndChild();
    return;
  }
  draw_scene_section(context);
  runtime::ReplaySession* replay = context.shows.replay;
  if (replay != nullptr) draw_replay_section(context, *replay);
  ImGui::PushStyleVar(ImGuiStyleVar_DisabledAlpha, kLockedAlpha);
  ImGui::BeginDisabled(replay != nullptr);
  draw_dimmed(context, asked_for(context).algorithm, draw_algorithm_section);
  if (context.state.persisted.more) {
    draw_more_sections(context);
  } else if (button(
                 "More###more",
                 "Every parameter, comparison, pages and plot controls. Settings, layout, brings "
                 "back what is shown now.",
                 {.width = ImGui::GetContentRegionAvail().x})) {
    show_more(context.state.persisted);
  }
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void move_panel(const PanelContext& context, float width, const Split& split) {
  double& ems = context.state.persisted.panel_ems;
  if (split.moved != 0.0F) {
    ems = std::max(static_cast<double>((width + split.moved) / ImGui::GetFontSize()),
                   static_cast<double>(kMinPanelWidthEms));
  }
  if (split.reset) ems = PersistedState{}.panel_ems;
}

// Scale of the initial wall view at the contact, pixels per metre.
double view_scale(const PanelContext& context, ImVec2 size) {
  constexpr double kProbeM = 1e-3;
  const Scene& scene = context.session.scene();
  if (scene.x().walls.empty()) return 1.0;
  const WallCamera camera = wall_view_camera(scene, size);
  const double face_m = scene.x().walls.front().position_m;
  const glm::vec2 face = camera.pixel_of({camera.x_of(face_m), 0.0F, 0.0F});
  const glm::vec2 beside = camera.pixel_of({camera.x_of(face_m + kProbeM), 0.0F, 0.0F});
  return static_cast<double>(glm::distance(face, beside)) / kProbeM;
}

// The magnifier on the right of the views, and the gap before it.
void draw_contact(const PanelContext& context, const draw::SampleHistory& history, ImVec2 gap,
                  ImVec2 views, double pixels_per_m) {
  ImGui::SameLine();
  ImGui::BeginChild("contact", ImVec2(0.0F, 0.0F),
                    ImGuiChildFlags_Borders | ImGuiChildFlags_NavFlattened, kStill);
  draw_magnifier(context, history, pixels_per_m);
  ImGui::EndChild();
  const Split split = draw_splitter(context, "picture splitter", SplitWay::kColumns, gap, views.y);
  move_share(context.state.persisted.picture_share, split, views.x, PersistedState{}.picture_share);
}

void draw_views(const PanelContext& context, const draw::SampleHistory& history,
                WallRenderer& renderer, ImVec2 size) {
  const double share = context.state.persisted.picture_share;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::BeginChild("views", size, ImGuiChildFlags_NavFlattened,
                    ImGuiWindowFlags_NoBackground | kStill);
  const bool more = context.state.persisted.more;
  const float width = more ? std::floor(static_cast<float>(share) * size.x) : size.x;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(1.0F, 1.0F));
  ImGui::BeginChild("wall", ImVec2(width, 0.0F),
                    ImGuiChildFlags_Borders | ImGuiChildFlags_NavFlattened, kStill);
  ImGui::PopStyleVar();
  const double pixels_per_m = view_scale(context, ImGui::GetContentRegionAvail());
  draw_wall_view(context, renderer);
  ImGui::EndChild();
  if (more) draw_contact(context, history, {corner.x + width, corner.y}, size, pixels_per_m);
  ImGui::EndChild();
}

void draw_right(const PanelContext& context, const draw::SampleHistory& history,
                WallRenderer& renderer, float height) {
  double& share = context.state.persisted.view_share;
  ImGui::BeginChild("right", ImVec2(0.0F, height), ImGuiChildFlags_NavFlattened,
                    ImGuiWindowFlags_NoBackground);
  draw_arming_strip(context);
  draw_toolbar(context);
  draw_tour_strip(context);
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

// The messages are above the status, at the right edge.
void draw_over_everything(const PanelContext& context, ImVec2 lower_right) {
  draw_help(context);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  draw_toasts(context, lower_right.x - gap, lower_right.y - gap);
}

}  // namespace

void draw_window(const PanelContext& context, const draw::SampleHistory& history,
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
      2.0F * (draw::kSmallFontSize * style.FontScaleMain + style.ItemSpacing.y) +
      style.ItemSpacing.y;
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
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  draw_hint_row(context);
  draw_status_row(context);
  ImGui::PopFont();
  ImGui::End();
  draw_over_everything(context, ImVec2(corner.x + free.x, corner.y + height));
}

}  // namespace hapticwall::ui
