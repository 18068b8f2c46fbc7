#include "app/draw/plot/plot_labels.h"

#include <algorithm>
#include <array>

namespace hapticwall::draw {
namespace {

constexpr float kLabelGapEms = 0.5F;  // gap between two labels

}  // namespace

void PlotInk::clear() {
  taken.clear();
  ends.clear();
}

// Neighbouring pieces share a box if that box is hardly higher than they are, so that a label is
// checked against few boxes.
void PlotInk::take(const PixelBox& box) {
  constexpr float kMaxWidth = 24.0F;
  constexpr float kMaxMore = 4.0F;  // height
  if (!taken.empty()) {
    PixelBox& last = taken.back();
    const PixelBox both{{std::min(last.from.x, box.from.x), std::min(last.from.y, box.from.y)},
                        {std::max(last.to.x, box.to.x), std::max(last.to.y, box.to.y)}};
    const float higher = std::max(last.to.y - last.from.y, box.to.y - box.from.y);
    if (both.to.x - both.from.x <= kMaxWidth && both.to.y - both.from.y <= higher + kMaxMore) {
      last = both;
      return;
    }
  }
  taken.push_back(box);
}

void PlotInk::take(std::span<const ImVec2> points, float weight) {
  const float half = 0.5F * weight;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto [left, right] = std::minmax(points[i - 1].x, points[i].x);
    const auto [top, bottom] = std::minmax(points[i - 1].y, points[i].y);
    take({{left - half, top - half}, {right + half, bottom + half}});
  }
}

std::optional<ImVec2> take_free_place(PlotInk& ink, const PixelBox& area, ImVec2 size,
                                      std::span<const ImVec2> corners) {
  for (const ImVec2 corner : corners) {
    const PixelBox box{corner, {corner.x + size.x, corner.y + size.y}};
    if (box.from.x < area.from.x || box.to.x > area.to.x || box.from.y < area.from.y ||
        box.to.y > area.to.y)
      continue;
    if (std::ranges::any_of(ink.taken, [&](const PixelBox& each) { return each.touches(box); }))
      continue;
    const float gap = kLabelGapEms * ImGui::GetFontSize();
    ink.taken.push_back({{box.from.x - gap, box.from.y}, {box.to.x + gap, box.to.y}});
    return corner;
  }
  return std::nullopt;
}

void draw_line_ends(PlotInk& ink, const PixelBox& area, ImDrawList* list) {
  const float gap = 0.25F * ImGui::GetFontSize();
  for (const LineEnd& end : ink.ends) {
    const ImVec2 size = ImGui::CalcTextSize(end.label);
    const float x = std::min(end.place.x, area.to.x - gap) - size.x;
    const float above = end.place.y - gap - size.y;
    const float below = end.place.y + gap;
    const std::array corners{ImVec2(x, above), ImVec2(x, below), ImVec2(x, above - 0.5F * size.y),
                             ImVec2(x, below + 0.5F * size.y)};
    if (const auto place = take_free_place(ink, area, size, corners))
      list->AddText(*place, end.colour, end.label);
  }
}

}  // namespace hapticwall::draw
