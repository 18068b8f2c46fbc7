#include "app/ui/widget/toasts.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace hapticwall::ui {
namespace {

constexpr float kToastWidthEms = 30.0F;
constexpr float kBarEms = 0.25F;  // the coloured bar at the left edge
// A longer frame (a figure was drawn) does not count as reading time.
constexpr double kMaxFrameS = 0.5;
constexpr std::size_t kMaxShown = 5;  // the newest; older ones are only counted

// Requests of clicks and pointer, applied after all toasts are drawn.
struct Wishes {
  std::uint64_t looked_at = 0;
  std::uint64_t put_away = 0;
  bool clear = false;
};

void draw_words(const Toast& toast) {
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(toast.message.text.c_str());
  ImGui::PopTextWrapPos();
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  if (ImGui::SmallButton("Copy###copy message"))
    ImGui::SetClipboardText(toast.message.text.c_str());
  ImGui::SameLine();
  const bool stays = toast.message.kind == MessageKind::kProblem;
  ImGui::TextDisabled(stays ? "stays until it is clicked" : "click to put away");
  if (toast.times > 1) {
    ImGui::SameLine();
    ImGui::TextDisabled("%d times", toast.times);
  }
}

void draw_bar(const PanelContext& context, const Toast& toast) {
  const bool problem = toast.message.kind == MessageKind::kProblem;
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  ImGui::GetWindowDrawList()->AddRectFilled(
      corner, ImVec2(corner.x + kBarEms * ImGui::GetFontSize(), corner.y + size.y),
      context.theme.packed(problem ? draw::Tone::kBad : draw::Tone::kGood, opacity(toast)));
}

// Begins a window over everything else; end it with end_overlay().
void begin_overlay(const PanelContext& context, const std::string& name, ImVec2 lower_right) {
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoDocking |
      ImGuiWindowFlags_AlwaysAutoResize;
  ImGui::SetNextWindowPos(lower_right, ImGuiCond_Always, ImVec2(1.0F, 1.0F));
  begin_raised(context.theme);
  ImGui::Begin(name.c_str(), nullptr, kFlags);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
}

void end_overlay() {
  ImGui::End();
  draw::end_raised();
}

void draw_clear(const PanelContext& context, std::size_t more, ImVec2 lower_right, Wishes& wishes) {
  begin_overlay(context, "##toasts", lower_right);
  if (more > 0) {
    ImGui::TextDisabled("%zu older", more);
    ImGui::SameLine();
  }
  if (ImGui::SmallButton("Put all away###put all away")) wishes.clear = true;
  end_overlay();
}

// Returns the upper edge.
float draw_toast(const PanelContext& context, const Toast& toast, ImVec2 lower_right,
                 Wishes& wishes) {
  const float width =
      std::min(kToastWidthEms * ImGui::GetFontSize(), ImGui::GetMainViewport()->WorkSize.x);
  ImGui::SetNextWindowSize(ImVec2(width, 0.0F));
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * opacity(toast));
  begin_overlay(context, fmt::format("##toast{}", toast.id), lower_right);
  draw_bar(context, toast);
  draw_words(toast);
  const ImVec2 corner = ImGui::GetWindowPos();
  if (ImGui::IsWindowHovered()) {
    wishes.looked_at = toast.id;
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !ImGui::IsAnyItemHovered())
      wishes.put_away = toast.id;
  }
  end_overlay();
  ImGui::PopStyleVar();
  return corner.y;
}

}  // namespace

void draw_toasts(const PanelContext& context, float right, float bottom) {
  Toasts& toasts = context.toasts;
  const std::vector<Toast>& list = toasts.list();
  const std::size_t shown = std::min(list.size(), kMaxShown);
  Wishes wishes;
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  // Toasts are drawn from the newest upwards.
  for (std::size_t i = 0; i < shown; ++i)
    bottom = draw_toast(context, list[list.size() - 1 - i], ImVec2(right, bottom), wishes) - gap;
  if (list.size() > 1) draw_clear(context, list.size() - shown, ImVec2(right, bottom), wishes);
  const auto frame_s = static_cast<double>(ImGui::GetIO().DeltaTime);
  toasts.pass(std::min(frame_s, kMaxFrameS), wishes.looked_at);
  if (wishes.put_away != 0) toasts.put_away(wishes.put_away);
  if (wishes.clear) toasts.clear();
}

}  // namespace hapticwall::ui
