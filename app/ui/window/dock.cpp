#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/ui/panel/layout_choice.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "app/ui/window/dock_nodes.h"
#include "app/ui/window/window_layout.h"

namespace hapticwall::ui {
namespace {

constexpr int kSettlingFrames = 3;  // a window has its size in the second frame
constexpr ImVec2 kMinPartEms(10.0F, 5.0F);
constexpr ImVec2 kFloatingEms(36.0F, 24.0F);  // size of a window that never floated before

DockSituation situation_of(const PanelContext& context) {
  const CompareState::Transient& compare = context.compare.transient;
  const bool more = context.window.more;
  // The first minute has no page for the result of an experiment.
  const bool result = !more && compare.test && !compare.setting_up;
  if (context.shows.hides_force || result) return DockSituation::kBlindTest;
  return more ? DockSituation::kChosen : DockSituation::kFirstMinute;
}

// Layout without the windows that would reveal the order, and with that of the test.
DockLayout blind_layout(const DockLayout& chosen) {
  std::vector<std::string> hidden;
  for (const Page& page : pages()) {
    if (page.hidden_by_blind_test) hidden.emplace_back(page.window.name);
  }
  DockLayout layout = without(chosen, hidden);
  bring_to_front(layout, kBlindTestPage);
  return layout;
}

// A page that the machine cannot fill has no place in any layout.
std::vector<std::string> lacking_pages(const Capabilities& can) {
  std::vector<std::string> names;
  for (const Page& page : pages()) {
    if (!has(can, page.needs)) names.emplace_back(page.window.name);
  }
  return names;
}

DockLayout layout_of(DockSituation situation, const DockLayout& chosen) {
  if (situation == DockSituation::kBlindTest) return blind_layout(chosen);
  return situation == DockSituation::kChosen ? chosen : *parse_layout(kFirstMinute);
}

// Arranges the windows. Call it before DockSpace().
void arrange(const PanelContext& context, ImGuiID id, ImVec2 size) {
  DockState& dock = context.dock;
  if (!dock.chosen) {
    restore_layout(context.dock, context.toasts);
    if (context.compare.transient.test) bring_to_front(*dock.chosen, kBlindTestPage);
  }
  const DockSituation situation = situation_of(context);
  const bool rebuild = std::exchange(dock.rebuild, false) || situation != dock.situation;
  const float scale = ImGui::GetStyle().FontScaleMain;
  if (!rebuild && size.x == dock.size.x && size.y == dock.size.y && scale == dock.scale) return;
  dock.size = size;
  dock.scale = scale;
  dock.settling = kSettlingFrames;
  if (rebuild) {
    dock.situation = situation;
    dock.shown = without(layout_of(situation, *dock.chosen), lacking_pages(context.can));
    build_dock(id, dock.shown, size);
  } else {
    fit_dock(id, dock.shown, size);
  }
}

void submit_dock_space(DockSituation situation, ImGuiID id, ImVec2 size) {
  ImGuiDockNodeFlags flags = ImGuiDockNodeFlags_AutoHideTabBar;
  if (situation != DockSituation::kChosen)
    flags |= static_cast<ImGuiDockNodeFlags>(ImGuiDockNodeFlags_NoTabBar) |
             ImGuiDockNodeFlags_NoUndocking;
  const ImVec2 least(ems(kMinPartEms.x), ems(kMinPartEms.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, least);
  // Gaps have the colour of the background.
  ImGui::PushStyleColor(ImGuiCol_Border, IM_COL32_BLACK_TRANS);
  flatten_next();
  ImGui::DockSpace(id, size, flags);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

// Returns whether it is seen.
bool draw_page(const PageParts& parts, const Page& page, bool closable) {
  const PanelContext& context = parts.context;
  const std::string name = page.window.name;
  const ImGuiStyle& style = ImGui::GetStyle();
  const bool covered = (page.flags & ImGuiWindowFlags_NoBackground) != 0;
  bool open = true;
  prepare_docked(name);
  ImGui::SetNextWindowSize(ImVec2(ems(kFloatingEms.x), ems(kFloatingEms.y)),
                           ImGuiCond_FirstUseEver);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, style.ChildBorderSize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      covered ? ImVec2(1.0F, 1.0F) : style.WindowPadding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, context.theme.colour(draw::Tone::kPanel));
  const bool seen =
      ImGui::Begin(dock_window(name).c_str(), closable ? &open : nullptr,
                   page.flags | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoCollapse);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  explain_tab(page.window.meaning);
  if (seen) page.draw(parts);
  ImGui::End();
  DockState& dock = context.dock;
  if (!open) {
    dock.chosen = without(*dock.chosen, std::array{name});
    dock.docked = layout_text(*dock.chosen);
    dock.rebuild = true;
  }
  return seen;
}

void draw_pages(const PageParts& parts) {
  const DockState& dock = parts.context.dock;
  const std::vector<std::string> shown = windows_of(dock.shown);
  for (const Page& page : pages()) {
    const bool open = std::ranges::find(shown, page.window.name) != shown.end();
    const bool seen = open && draw_page(parts, page, dock.situation == DockSituation::kChosen);
    if (page.notice != nullptr) page.notice(parts, seen);
  }
}

// Notes what the user has moved since the sizes were set.
void note_moved(DockState& dock, ImGuiID id) {
  DockLayout now = read_dock(id);
  const bool settling = dock.settling > 0;
  if (settling) --dock.settling;
  if (now == dock.measured) return;
  dock.measured = now;
  if (settling || dock.rebuild) return;
  dock.shown = std::move(now);
  if (dock.situation != DockSituation::kChosen) return;
  dock.chosen = dock.shown;
  dock.docked = layout_text(dock.shown);
}

}  // namespace

void draw_dock(const PageParts& parts, ImVec2 size) {
  DockState& dock = parts.context.dock;
  if (dock.windows.empty()) {
    for (const Page& page : pages()) {
      if (has(parts.context.can, page.needs)) dock.windows.push_back(page.window);
    }
  }
  const ImGuiID id = ImGui::GetID("dock");
  arrange(parts.context, id, size);
  submit_dock_space(dock.situation, id, size);
  share_arrows(true);  // also for windows that were docked in this frame
  draw_pages(parts);
  share_arrows(false);
  keep_floating_inside();
  note_moved(dock, id);
}

}  // namespace hapticwall::ui
