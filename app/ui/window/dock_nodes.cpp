#include "app/ui/window/dock_nodes.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cstddef>

namespace hapticwall::ui {
namespace {

constexpr float kMaxColumnShare = 0.5F;  // max share of a column of fixed width

// Text size, px. Correct also in the frame that changes the scale, in which ImGui::GetFontSize() is
// still the old one.
float text_size() { return ImGui::GetStyle().FontSizeBase * ImGui::GetStyle().FontScaleMain; }

ImGuiWindow* window_of(const std::string& page) {
  return ImGui::FindWindowByName(dock_window(page).c_str());
}

ImGuiID tab_id(const std::string& page) {
  return ImHashStr("#TAB", 0, ImHashStr(dock_window(page).c_str()));
}

// "Plots###page Plots" is "Plots".
std::string page_of(const ImGuiWindow& window) {
  const std::string name = window.Name;
  return name.substr(0, name.find("###"));
}

bool is_dock_window(const ImGuiWindow& window) {
  return std::string_view(window.Name).find("###page ") != std::string_view::npos;
}

// Index of a coordinate of ImVec2.
std::size_t axis_of(DockSplit split) { return split == DockSplit::kColumns ? 0 : 1; }

void dock_tab(const std::string& page, ImGuiID node, std::size_t index) {
  const std::string name = dock_window(page);
  const auto order = static_cast<short>(index);
  ImGui::DockBuilderDockWindow(name.c_str(), node);
  if (ImGuiWindow* window = window_of(page)) {
    window->DockOrder = order;
  } else {
    ImGui::FindWindowSettingsByID(ImHashStr(name.c_str()))->DockOrder = order;
  }
}

void build_part(const DockPart& part, ImGuiID id) {
  if (part.split != DockSplit::kNone) {
    ImGuiID first = 0;
    ImGuiID second = 0;
    const ImGuiDir way = part.split == DockSplit::kColumns ? ImGuiDir_Left : ImGuiDir_Up;
    ImGui::DockBuilderSplitNode(id, way, 0.5F, &first, &second);
    build_part(part.parts.front(), first);
    build_part(part.parts.back(), second);
    return;
  }
  for (std::size_t i = 0; i < part.tabs.size(); ++i) dock_tab(part.tabs[i], id, i);
  ImGuiDockNode* node = ImGui::DockBuilderGetNode(id);
  if (!part.tabs.empty()) node->SelectedTabId = tab_id(part.tabs[part.front]);
  // A central node would stay when it is empty, and would take the sizes of all others.
  if (!node->IsRootNode()) node->SetLocalFlags(node->LocalFlags & ~ImGuiDockNodeFlags_CentralNode);
}

// Length of the first part, px.
float first_length(const DockPart& part, float free) {
  if (part.ems == 0.0) return free * static_cast<float>(part.share);
  const float most = kMaxColumnShare * free;
  const float column = std::min(static_cast<float>(std::abs(part.ems)) * text_size(), most);
  return part.ems > 0.0 ? column : free - column;
}

void fit_part(const DockPart& part, ImGuiDockNode& node, ImVec2 size) {
  if (part.split == DockSplit::kNone || !node.IsSplitNode()) return;
  const std::size_t axis = axis_of(part.split);
  const float free = std::max(size[axis] - ImGui::GetStyle().DockingSeparatorSize, 2.0F);
  const float first = std::floor(first_length(part, free));
  for (std::size_t i = 0; i < part.parts.size(); ++i) {
    size[axis] = i == 0 ? first : free - first;
    node.ChildNodes[i]->SizeRef = size;
    fit_part(part.parts[i], *node.ChildNodes[i], size);
  }
}

// Holds the controls, and is one column: its width follows the size of the text.
bool is_column_of_controls(const DockPart& part) {
  if (part.split == DockSplit::kColumns) return false;
  return std::ranges::find(part.tabs, kControlsPage) != part.tabs.end() ||
         std::ranges::any_of(part.parts, is_column_of_controls);
}

void read_size(DockPart& part, float first, float second) {
  const auto ems = [](float length) {
    return std::clamp(static_cast<double>(length / text_size()), kMinColumnEms, kMaxColumnEms);
  };
  part.share = std::clamp(static_cast<double>(first / std::max(first + second, 1.0F)),
                          kMinDockShare, kMaxDockShare);
  if (part.split != DockSplit::kColumns) return;
  if (is_column_of_controls(part.parts.front())) {
    part.ems = ems(first);
  } else if (is_column_of_controls(part.parts.back())) {
    part.ems = -ems(second);
  }
}

void read_tab(DockPart& leaf, const ImGuiWindow* window, ImGuiID front) {
  if (window == nullptr || !window->Active || !is_dock_window(*window)) return;
  if (window->TabId == front) leaf.front = leaf.tabs.size();
  leaf.tabs.push_back(page_of(*window));
}

DockPart read_part(const ImGuiDockNode& node) {
  DockPart part;
  if (!node.IsSplitNode()) {
    if (node.TabBar != nullptr) {
      for (const ImGuiTabItem& tab : node.TabBar->Tabs)
        read_tab(part, tab.Window, node.SelectedTabId);
    } else {
      for (const ImGuiWindow* window : node.Windows) read_tab(part, window, node.SelectedTabId);
    }
    return part;
  }
  DockPart first = read_part(*node.ChildNodes[0]);
  DockPart second = read_part(*node.ChildNodes[1]);
  if (first.empty()) return second;
  if (second.empty()) return first;
  part.split = node.SplitAxis == ImGuiAxis_X ? DockSplit::kColumns : DockSplit::kRows;
  part.parts = {std::move(first), std::move(second)};
  const std::size_t axis = axis_of(part.split);
  read_size(part, node.ChildNodes[0]->Size[axis], node.ChildNodes[1]->Size[axis]);
  return part;
}

ImRect area_of(DockPlace place, const ImGuiDockNode& root) {
  const auto at = [](double share, float whole) {
    return std::floor(static_cast<float>(share) * whole);
  };
  const ImVec2 from(root.Pos.x + at(place.x, root.Size.x), root.Pos.y + at(place.y, root.Size.y));
  return {from,
          ImVec2(from.x + at(place.width, root.Size.x), from.y + at(place.height, root.Size.y))};
}

DockPlace place_of(ImVec2 from, ImVec2 size, const ImGuiDockNode& root) {
  const auto share = [](float length, float whole, double least) {
    return std::clamp(static_cast<double>(length / std::max(whole, 1.0F)), least, 1.0);
  };
  return {share(from.x - root.Pos.x, root.Size.x, 0.0),
          share(from.y - root.Pos.y, root.Size.y, 0.0), share(size.x, root.Size.x, kMinDockShare),
          share(size.y, root.Size.y, kMinDockShare)};
}

// A single window has no node of its own.
void place_single(const std::string& page, const ImRect& area) {
  const std::string name = dock_window(page);
  ImGui::DockBuilderDockWindow(name.c_str(), 0);
  if (ImGuiWindow* window = window_of(page)) {
    ImGui::SetWindowPos(window, area.Min);
    ImGui::SetWindowSize(window, area.GetSize());
    return;
  }
  ImGuiWindowSettings* settings = ImGui::FindWindowSettingsByID(ImHashStr(name.c_str()));
  settings->Pos = ImVec2ih(area.Min);
  settings->Size = ImVec2ih(area.GetSize());
}

void build_floating(const DockPart& part, const ImRect& area) {
  if (part.tabs.size() == 1) return place_single(part.tabs.front(), area);
  const ImGuiID node = ImGui::DockBuilderAddNode(0, ImGuiDockNodeFlags_None);
  ImGui::DockBuilderSetNodePos(node, area.Min);
  ImGui::DockBuilderSetNodeSize(node, area.GetSize());
  build_part(part, node);
  fit_part(part, *ImGui::DockBuilderGetNode(node), area.GetSize());
  ImGui::DockBuilderFinish(node);
}

void keep_inside(ImGuiWindow& window) {
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const ImVec2 size(std::min(window.SizeFull.x, screen.WorkSize.x),
                    std::min(window.SizeFull.y, screen.WorkSize.y));
  const ImVec2 place(
      std::clamp(window.Pos.x, screen.WorkPos.x, screen.WorkPos.x + screen.WorkSize.x - size.x),
      std::clamp(window.Pos.y, screen.WorkPos.y, screen.WorkPos.y + screen.WorkSize.y - size.y));
  if (size.x != window.SizeFull.x || size.y != window.SizeFull.y)
    ImGui::SetWindowSize(&window, size);
  if (place.x != window.Pos.x || place.y != window.Pos.y) ImGui::SetWindowPos(&window, place);
}

bool floats(const ImGuiWindow& window) {
  if (!window.Active) return false;
  if (window.DockNodeAsHost != nullptr) return window.DockNodeAsHost->IsFloatingNode();
  return is_dock_window(window) && !window.DockIsActive && window.RootWindow == &window;
}

}  // namespace

std::string dock_window(const std::string& page) { return fmt::format("{0}###page {0}", page); }

void build_dock(ImGuiID id, const DockLayout& layout, ImVec2 size) {
  share_arrows(false);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::DockBuilderRemoveNode(id);
  ImGui::DockBuilderAddNode(id, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodePos(id, corner);
  ImGui::DockBuilderSetNodeSize(id, size);
  build_part(layout.docked, id);
  fit_dock(id, layout, size);
  ImGui::DockBuilderFinish(id);
  for (const auto& [part, place] : layout.floating)
    build_floating(part, area_of(place, *ImGui::DockBuilderGetNode(id)));
}

void fit_dock(ImGuiID id, const DockLayout& layout, ImVec2 size) {
  if (ImGuiDockNode* node = ImGui::DockBuilderGetNode(id)) fit_part(layout.docked, *node, size);
}

DockLayout read_dock(ImGuiID id) {
  const ImGuiDockNode& root = *ImGui::DockBuilderGetNode(id);
  DockLayout layout{read_part(root), {}};
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!floats(*window)) continue;
    FloatingPart floating{{}, place_of(window->Pos, window->SizeFull, root)};
    if (window->DockNodeAsHost != nullptr) {
      floating.part = read_part(*window->DockNodeAsHost);
    } else {
      floating.part.tabs = {page_of(*window)};
    }
    if (!floating.part.empty()) layout.floating.push_back(std::move(floating));
  }
  return layout;
}

void keep_floating_inside() {
  for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (floats(*window)) keep_inside(*window);
  }
}

void flatten_next() {
  ImGuiNextWindowData& next = ImGui::GetCurrentContext()->NextWindowData;
  next.HasFlags |= ImGuiNextWindowDataFlags_HasChildFlags;
  next.ChildFlags = ImGuiChildFlags_NavFlattened;
}

void share_arrows(bool shared) {
  for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!is_dock_window(*window)) continue;
    ImGuiDockNode* node = window->DockNode;
    const bool docked = node != nullptr && node->HostWindow != nullptr &&
                        ImGui::DockNodeGetRootNode(node)->IsDockSpace();
    window->ChildFlags &= ~ImGuiChildFlags_NavFlattened;
    if (shared && docked) window->ChildFlags |= ImGuiChildFlags_NavFlattened;
  }
}

void prepare_docked(const std::string& page) {
  const ImGuiWindow* window = window_of(page);
  if (window == nullptr || (window->ChildFlags & ImGuiChildFlags_NavFlattened) == 0) return;
  flatten_next();
  ImGui::SetNextWindowBgAlpha(0.0F);  // the ground of the program's window has its colour
}

}  // namespace hapticwall::ui
