#include "app/ui/widget/overflow_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kOverflowEms = 2.0F;

// Returns the left end of the control that refuses, if one does.
std::optional<float> draw_staying(const PanelContext& context, std::span<const RowControl> controls,
                                  const std::vector<bool>& stays, ImVec2 place) {
  std::optional<float> refused;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    if (!stays[i]) continue;
    ImGui::SetCursorScreenPos(place);
    controls[i].draw();
    if (is_refused(context, controls[i].refusal)) refused = place.x;
    place.x += controls[i].width + ImGui::GetStyle().ItemSpacing.x;
  }
  return refused;
}

// The rest of the controls, below the right end of the row.
void draw_overflowing(const PanelContext& context, const char* name,
                      std::span<const RowControl> controls, const std::vector<bool>& stays) {
  const ImVec2 corner(ImGui::GetItemRectMax().x,
                      ImGui::GetItemRectMax().y + ImGui::GetStyle().ItemInnerSpacing.y);
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, ImVec2(1.0F, 0.0F));
  if (!ImGui::BeginPopup(name)) return;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    if (stays[i]) continue;
    controls[i].draw();
    draw_refusal(context, controls[i].refusal);
  }
  ImGui::EndPopup();
}

bool wants_popup(std::span<const RowControl> controls, const std::vector<bool>& stays) {
  for (std::size_t i = 0; i < controls.size(); ++i) {
    if (controls[i].takes_keyboard && !stays[i]) return true;
  }
  return false;
}

}  // namespace

void draw_overflow_row(const PanelContext& context, const char* name,
                       std::span<const RowControl> controls, const RowLook& look) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = look.room > 0.0F ? look.room : ImGui::GetContentRegionAvail().x;
  const float more = ems(kOverflowEms);
  const std::vector<bool> stays =
      controls_in_row(controls, width, ImGui::GetStyle().ItemSpacing.x, more);
  const std::optional<float> refused = draw_staying(context, controls, stays, corner);
  if (!std::ranges::all_of(stays, std::identity())) {
    ImGui::SetCursorScreenPos(ImVec2(corner.x + width - more, corner.y));
    const bool clicked =
        button(fmt::format("…###more of {}", name), "Controls that do not fit in this row",
               {.width = more, .small = look.small});
    if (clicked || wants_popup(controls, stays)) ImGui::OpenPopup(name);
    draw_overflowing(context, name, controls, stays);
  }
  if (!refused) return;
  ImGui::SetCursorScreenPos(ImVec2(*refused, ImGui::GetCursorScreenPos().y));
  for (const RowControl& control : controls) draw_refusal(context, control.refusal);
}

std::vector<bool> controls_in_row(std::span<const RowControl> controls, float width, float gap,
                                  float more) {
  float all = -gap;
  for (const RowControl& control : controls) all += control.width + gap;
  std::vector<bool> stays(controls.size(), all <= width);
  if (all <= width) return stays;
  std::vector<std::size_t> order(controls.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return controls[i].rank; });
  float free = width - more;
  for (const std::size_t i : order) {
    const float wanted = controls[i].width + gap;
    if (wanted > free) continue;
    stays[i] = true;
    free -= wanted;
  }
  return stays;
}

}  // namespace hapticwall::ui
