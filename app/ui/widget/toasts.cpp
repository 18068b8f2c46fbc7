#include "app/ui/toasts.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

#include "app/ui/ui_state.h"
#include "app/ui/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kToastWidthEms = 30.0F;
constexpr float kBarEms = 0.25F;  // the coloured bar at the left edge
// A frame that took longer (a figure was drawn meanwhile) was no time to read in.
constexpr double kLongestFrameS = 0.5;
constexpr std::size_t kMostShown = 5;  // of the newest; the others are counted

// What a click or the pointer asked for, applied after all are drawn.
struct Wishes {
  std::uint64_t looked_at = 0;
  std::uint64_t put_away = 0;
  bool clear = false;
};

void draw_words(const PanelContext& context, const Toast& toast) {
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(toast.message.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PushFont(nullptr, kSmallFontSize);
  if (ImGui::SmallButton("Copy")) ImGui::SetClipboardText(toast.message.text.c_str());
  remember_item(context.state, "copy message");
  ImGui::SameLine();
  const bool stays = toast.message.kind == MessageKind::kProblem;
  ImGui::TextDisabled(stays ? "stays until it is clicked" : "click to put away");
  if (toast.times > 1) {
    ImGui::SameLine();
    ImGui::TextDisabled("%d times", toast.times);
  }
  ImGui::PopFont();
}

void draw_bar(const PanelContext& context, const Toast& toast) {
  const bool problem = toast.message.kind == MessageKind::kProblem;
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  ImGui::GetWindowDrawList()->AddRectFilled(
      corner, ImVec2(corner.x + kBarEms * ImGui::GetFontSize(), corner.y + size.y),
      context.theme.packed(problem ? Tone::kBad : Tone::kGood, opacity(toast)));
}

// A window of its own over everything else; to be ended.
void begin_overlay(const PanelContext& context, const std::string& name, ImVec2 lower_right) {
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_AlwaysAutoResize;
  ImGui::SetNextWindowPos(lower_right, ImGuiCond_Always, ImVec2(1.0F, 1.0F));
  begin_raised(context.theme);
  ImGui::Begin(name.c_str(), nullptr, kFlags);
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
}

void end_overlay() {
  ImGui::End();
  end_raised();
}

void draw_clear(const PanelContext& context, std::size_t more, ImVec2 lower_right, Wishes& wishes) {
  begin_overlay(context, "##toasts", lower_right);
  if (more > 0) {
    ImGui::TextDisabled("%zu older", more);
    ImGui::SameLine();
  }
  if (ImGui::SmallButton("Put all away")) wishes.clear = true;
  remember_item(context.state, "put all away");
  end_overlay();
}

// Returns the upper edge.
float draw_toast(const PanelContext& context, const Toast& toast, ImVec2 lower_right, bool newest,
                 Wishes& wishes) {
  const float width =
      std::min(kToastWidthEms * ImGui::GetFontSize(), ImGui::GetMainViewport()->WorkSize.x);
  ImGui::SetNextWindowSize(ImVec2(width, 0.0F));
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * opacity(toast));
  begin_overlay(context, fmt::format("##toast{}", toast.id), lower_right);
  draw_bar(context, toast);
  draw_words(context, toast);
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  if (ImGui::IsWindowHovered()) {
    wishes.looked_at = toast.id;
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !ImGui::IsAnyItemHovered())
      wishes.put_away = toast.id;
  }
  end_overlay();
  ImGui::PopStyleVar();
  const ItemRect rect{corner, ImVec2(corner.x + size.x, corner.y + size.y)};
  context.state.transient.items.insert_or_assign(fmt::format("toast {}", toast.id), rect);
  if (newest) context.state.transient.items.insert_or_assign("message", rect);
  return corner.y;
}

}  // namespace

void draw_toasts(const PanelContext& context, float right, float bottom) {
  Toasts& toasts = context.state.transient.toasts;
  const std::vector<Toast>& list = toasts.list();
  const std::size_t shown = std::min(list.size(), kMostShown);
  Wishes wishes;
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  // From the newest upwards.
  for (std::size_t i = 0; i < shown; ++i)
    bottom =
        draw_toast(context, list[list.size() - 1 - i], ImVec2(right, bottom), i == 0, wishes) - gap;
  if (list.size() > 1) draw_clear(context, list.size() - shown, ImVec2(right, bottom), wishes);
  const auto frame_s = static_cast<double>(ImGui::GetIO().DeltaTime);
  toasts.pass(std::min(frame_s, kLongestFrameS), wishes.looked_at);
  if (wishes.put_away != 0) toasts.put_away(wishes.put_away);
  if (wishes.clear) toasts.clear();
}

void Toasts::tell(MessageKind kind, std::string text) {
  Toast toast{next_id_, {kind, std::move(text)}};
  const auto same = std::find_if(list_.begin(), list_.end(), [&](const Toast& other) {
    return other.message.kind == kind && other.message.text == toast.message.text;
  });
  if (same != list_.end()) {
    toast.id = same->id;
    toast.times = same->times + 1;
    list_.erase(same);
  } else {
    ++next_id_;
  }
  list_.push_back(std::move(toast));
  if (list_.size() > kMostToasts) list_.erase(list_.begin());
}

void Toasts::put_away(std::uint64_t id) {
  std::erase_if(list_, [id](const Toast& toast) { return toast.id == id; });
}

void Toasts::put_newest_away() {
  if (!list_.empty()) list_.pop_back();
}

void Toasts::pass(double seconds, std::uint64_t looked_at) {
  for (Toast& toast : list_) toast.age_s = toast.id == looked_at ? 0.0 : toast.age_s + seconds;
  std::erase_if(list_, [](const Toast& toast) {
    return toast.message.kind == MessageKind::kNote && toast.age_s >= kNoteLifeS;
  });
}

Message Toasts::newest() const { return list_.empty() ? Message{} : list_.back().message; }

bool Toasts::moving() const {
  return std::any_of(list_.begin(), list_.end(), [](const Toast& toast) {
    return toast.message.kind == MessageKind::kNote && toast.age_s >= kNoteLifeS - kFadeS;
  });
}

float opacity(const Toast& toast) {
  if (toast.message.kind == MessageKind::kProblem) return 1.0F;
  return static_cast<float>(std::clamp((kNoteLifeS - toast.age_s) / kFadeS, 0.0, 1.0));
}

}  // namespace hapticwall::ui
