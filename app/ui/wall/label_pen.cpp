#include "app/ui/wall/label_pen.h"

#include <algorithm>
#include <vector>

namespace hapticwall::ui {
namespace {

constexpr float kLabelEdge = 4.0F;   // pixels that are kept free
constexpr float kBesideText = 2.0F;  // pixels of background
constexpr float kLineAlpha = 0.7F;

float kept(float from, float edge, float room) {
  return std::clamp(from, edge + kLabelEdge, std::max(edge + kLabelEdge, edge + room - kLabelEdge));
}

}  // namespace

LabelPen::LabelPen(const draw::Theme& theme, const WallCamera& camera, const ViewArea& area,
                   std::span<const draw::PixelBox> taken)
    : theme_(theme), camera_(camera), area_(area), list_(ImGui::GetWindowDrawList()) {
  ink_.taken.assign(taken.begin(), taken.end());
}

ImVec2 LabelPen::screen(glm::vec3 point) const {
  const glm::vec2 pixel = camera_.pixel_of(point);
  return {area_.corner.x + pixel.x, area_.corner.y + pixel.y};
}

bool LabelPen::within(ImVec2 place) const {
  return place.x >= area_.corner.x && place.x <= area_.corner.x + area_.size.x &&
         place.y >= area_.corner.y && place.y <= area_.corner.y + area_.size.y;
}

bool LabelPen::is_free(const draw::PixelBox& box) const {
  return std::ranges::none_of(ink_.taken,
                              [&](const draw::PixelBox& each) { return each.touches(box); });
}

bool LabelPen::write(const Label& label, std::initializer_list<ImVec2> shifts) {
  const ImVec2 extent = ImGui::CalcTextSize(label.text.c_str());
  std::vector<ImVec2> corners;
  for (const ImVec2 shift : shifts) {
    const ImVec2 middle(label.place.x + shift.x, label.place.y + shift.y);
    corners.emplace_back(kept(middle.x - 0.5F * extent.x, area_.corner.x, area_.size.x - extent.x),
                         kept(middle.y - 0.5F * extent.y, area_.corner.y, area_.size.y - extent.y));
  }
  const ImVec2 end(area_.corner.x + area_.size.x, area_.corner.y + area_.size.y);
  const auto free = draw::take_free_place(ink_, {area_.corner, end}, extent, corners);
  if (!free) return false;
  line(label.thing, label.line_to, label.tone, kLineAlpha);
  list_->AddRectFilled(ImVec2(free->x - kBesideText, free->y),
                       ImVec2(free->x + extent.x + kBesideText, free->y + extent.y),
                       theme_.packed(draw::Tone::kPanel, draw::kBehindText), 3.0F);
  list_->AddText(*free, theme_.packed(label.tone), label.text.c_str());
  return true;
}

void LabelPen::line(ImVec2 from, ImVec2 to, draw::Tone tone, float alpha) const {
  list_->AddLine(from, to, theme_.packed(tone, alpha), 1.0F);
}

}  // namespace hapticwall::ui
