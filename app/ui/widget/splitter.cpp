#include "app/ui/widget/splitter.h"

#include <imgui_internal.h>

#include <algorithm>

namespace hapticwall::ui {
namespace {

constexpr double kMinSplitShare = 0.15;
constexpr double kMaxSplitShare = 0.85;
constexpr float kLineShare = 0.25F;  // of the gap

}  // namespace

Split draw_splitter(const PanelContext& context, const char* name, SplitWay way, ImVec2 from,
                    float length) {
  const bool columns = way == SplitWay::kColumns;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float gap = columns ? style.ItemSpacing.x : style.ItemSpacing.y;
  const ImVec2 size = columns ? ImVec2(gap, length) : ImVec2(length, gap);
  // Placed by hand, so that it does not affect the layout.
  const ImRect place(from, ImVec2(from.x + size.x, from.y + size.y));
  const ImGuiID id = ImGui::GetID(name);
  bool hovered = false;
  bool active = false;
  if (ImGui::ItemAdd(place, id)) ImGui::ButtonBehavior(place, id, &hovered, &active);
  Split split;
  if (!active && !hovered) return split;
  ImGui::SetMouseCursor(columns ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  const float inset = 0.5F * (1.0F - kLineShare) * gap;
  const ImVec2 line_from(from.x + (columns ? inset : 0.0F), from.y + (columns ? 0.0F : inset));
  const ImVec2 line_to(from.x + size.x - (columns ? inset : 0.0F),
                       from.y + size.y - (columns ? 0.0F : inset));
  ImGui::GetWindowDrawList()->AddRectFilled(
      line_from, line_to, context.theme.packed(draw::Tone::kAccent, active ? 1.0F : 0.6F));
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  if (active) split.moved = columns ? delta.x : delta.y;
  split.reset = hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  return split;
}

void move_share(double& share, const Split& split, float whole, double usual) {
  if (split.reset) {
    share = usual;
  } else if (split.moved != 0.0F && whole > 0.0F) {
    share = std::clamp(share + static_cast<double>(split.moved / whole), kMinSplitShare,
                       kMaxSplitShare);
  }
}

}  // namespace hapticwall::ui
