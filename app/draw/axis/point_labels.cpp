#include "app/draw/axis/point_labels.h"

#include <algorithm>

namespace hapticwall::draw {
namespace {

float overlap(const LabelBox& a, const LabelBox& b) {
  const float width = std::min(a.to.x, b.to.x) - std::max(a.from.x, b.from.x);
  const float height = std::min(a.to.y, b.to.y) - std::max(a.from.y, b.from.y);
  return width > 0.0F && height > 0.0F ? width * height : 0.0F;
}

// The places around `mark` for a text of this size: the preferred side first, then further away.
std::vector<ImVec2> label_corners(const LabelBox& mark, ImVec2 text, bool above) {
  std::vector<ImVec2> corners;
  for (const float away : {0.0F, 0.5F * text.y, text.y}) {
    const ImVec2 centre(0.5F * (mark.from.x + mark.to.x), 0.5F * (mark.from.y + mark.to.y));
    const float over = mark.from.y - text.y - away;
    const float under = mark.to.y + away;
    const float near = above ? over : under;
    const float far = above ? under : over;
    const float shift = above ? 0.0F : text.x;
    corners.insert(corners.end(),
                   {{centre.x - shift, near},
                    {centre.x - 0.5F * text.x, near},
                    {centre.x - text.x + shift, near},
                    {centre.x - text.x + shift, far},
                    {centre.x - 0.5F * text.x, far},
                    {mark.to.x + 0.2F * text.y + away, centre.y - 0.5F * text.y},
                    {mark.from.x - text.x - 0.2F * text.y - away, centre.y - 0.5F * text.y}});
  }
  return corners;
}

}  // namespace

std::optional<LabelBox> place_label(const LabelBox& mark, ImVec2 text, bool above,
                                    const TakenPlaces& taken) {
  std::optional<LabelBox> best;
  float least = 0.0F;
  for (const ImVec2& corner : label_corners(mark, text, above)) {
    const LabelBox box{corner, ImVec2(corner.x + text.x, corner.y + text.y)};
    const bool inside = box.from.x >= taken.area.from.x && box.to.x <= taken.area.to.x &&
                        box.from.y >= taken.area.from.y && box.to.y <= taken.area.to.y;
    const auto covers = [&](const LabelBox& other) { return overlap(box, other) > 0.0F; };
    if (!inside || std::ranges::any_of(taken.texts, covers)) continue;
    float covered = 0.0F;
    for (const LabelBox& other : taken.ink) covered += overlap(box, other);
    if (best && covered >= least) continue;
    best = box;
    least = covered;
  }
  return best;
}

}  // namespace hapticwall::draw
