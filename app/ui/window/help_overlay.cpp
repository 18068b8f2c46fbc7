#include "app/ui/window/help_overlay.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <optional>

#include "app/ui/panel/tour_strip.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "app/ui/window/keys.h"

namespace hapticwall::ui {
namespace {

constexpr float kWidthEms = 52.0F;
constexpr float kMarginEms = 2.0F;  // margin to the edges of a small window
constexpr float kKeyColumnShare = 0.36F;

struct Gesture {
  const char* where;
  const char* what;
  Needs needs = nullptr;
};
constexpr std::array kGestures{
    Gesture{"drag in the view", "leads the hand; it stays where you leave it"},
    Gesture{"right drag, wheel", "turns the view, zooms it"},
    Gesture{"drag, wheel in a plot", "moves and zooms its time"},
    Gesture{"… over its value axis", "moves and zooms its values"},
    Gesture{"click on a legend", "hides the line"},
    Gesture{"Ctrl+click on a slider", "types its value"},
    Gesture{"35k or 0,5 in a field", "35000 or 0.5"},
    Gesture{"↑ ↓ or Alt, then arrows", "reach the controls; Enter uses them"},
    Gesture{"drag a file to the window", "opens a scene or a recording", &Capabilities::files},
    Gesture{"rest on anything", "says what it is"}};

void heading(const PanelContext& context, const char* title) {
  ImGui::Dummy(ImVec2(0.0F, ems(0.3F)));
  heading_text(context, title);
}

void row(const PanelContext& context, const char* left, const char* right) {
  const float start = ImGui::GetCursorPosX();
  const float column = kKeyColumnShare * ImGui::GetContentRegionAvail().x;
  ImGui::TextUnformatted(left);
  ImGui::SameLine();
  // A long key text pushes the description.
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), start + column));
  draw::wrapped_text(context.theme.colour(draw::Tone::kMuted), right);
}

void draw_keys(const PanelContext& context) {
  std::optional<KeyGroup> group;
  for (const KeyBinding& binding : bindings_in_force(context.shows)) {
    if (!has(context.can, binding.needs)) continue;
    if (binding.group == KeyGroup::kPlots && group != KeyGroup::kPlots) ImGui::TableNextColumn();
    if (binding.group != group) heading(context, group_title(binding.group));
    group = binding.group;
    row(context, keys_text(binding).c_str(), binding.what.c_str());
  }
}

void draw_gestures(const PanelContext& context) {
  heading(context, "Pointer");
  for (const Gesture& gesture : kGestures) {
    if (has(context.can, gesture.needs)) row(context, gesture.where, gesture.what);
  }
}

void draw_content(const PanelContext& context) {
  draw::strong_text(context.theme, "Keys and pointer", draw::kTitleFontSize);
  ImGui::SameLine();
  constexpr const char* kClose = "Close (Esc)###close help";
  if (context.shows.live != nullptr && !context.shows.hides_algorithm &&
      button("The tour###tour of help", "Five lessons, a minute each")) {
    begin_tour(context);
    context.window.help_shown = false;
  }
  ImGui::SameLine();
  draw::align_right(button_width(kClose));
  if (ImGui::Button(kClose)) context.window.help_shown = false;
  if (ImGui::BeginTable("help", 2)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_keys(context);
    draw_gestures(context);
    ImGui::EndTable();
  }
  if (!context.can.devices) return;
  ImGui::Spacing();
  muted_text(context,
             "Space takes the force of a real device away, at any time. While a text is typed, "
             "the other keys are letters.");
}

}  // namespace

void draw_help(const PanelContext& context) {
  if (!context.window.help_shown) return;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoDocking;
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  const ImVec2 most(viewport->WorkSize.x - ems(kMarginEms), viewport->WorkSize.y - ems(kMarginEms));
  ImGui::SetNextWindowPos(viewport->GetWorkCenter(), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0.0F, 0.0F), most);
  ImGui::SetNextWindowSize(ImVec2(std::min(ems(kWidthEms), most.x), 0.0F));
  begin_raised(context.theme);
  ImGui::Begin("##help", nullptr, kFlags);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  draw_content(context);
  const bool elsewhere = ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
                         !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows |
                                                 ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  if (elsewhere && !ImGui::IsWindowAppearing()) context.window.help_shown = false;
  ImGui::End();
  draw::end_raised();
}

void put_away(const PanelContext& context) {
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) {
    ImGui::ClosePopupsExceptModals();
  } else if (context.window.help_shown) {
    context.window.help_shown = false;
  } else if (context.window.presents) {
    context.window.presents = false;
  } else {
    context.toasts.put_newest_away();
  }
}

}  // namespace hapticwall::ui
