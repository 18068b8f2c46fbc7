#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/draw/axis/dashes.h"
#include "app/draw/film/film_card.h"
#include "core/environment/environment.h"

namespace hapticwall::draw {
namespace {

constexpr float kFilmWallAlpha = 0.42F;
constexpr float kFilmSweptAlpha = 0.34F;
constexpr float kFilmHandleLevel = 0.50F;  // shares of the height
constexpr float kFilmHandLevel = 0.74F;
constexpr float kFilmHandleHalf = 0.085F;
constexpr float kFilmArrowLevel = 0.24F;
constexpr float kFilmWallTop = 0.10F;
constexpr float kFilmWallFoot = 0.86F;
constexpr float kFilmHandleLength = 0.30F;  // shares of the width
constexpr float kFilmArrowLength = 0.34F;   // at full scale

struct SideView {
  const FilmPen& pen;
  PixelBox box;
  const FilmMoment& moment;

  [[nodiscard]] float width() const { return box.to.x - box.from.x; }
  [[nodiscard]] float height() const { return box.to.y - box.from.y; }
  [[nodiscard]] float x_of(double position_m) const {
    const Extremes& view = moment.scales.view_m;
    const double share = (position_m - view.minimum) / (view.maximum - view.minimum);
    return box.from.x + static_cast<float>(std::clamp(share, -1.0, 2.0)) * width();
  }
  [[nodiscard]] float y_of(float share) const { return box.from.y + share * height(); }
  [[nodiscard]] float pixels(float usual) const { return usual * pen.scale; }
};

void draw_wall_blocks(const SideView& side) {
  const WallPicture& picture = side.moment.picture;
  const StiffnessScale scale = stiffness_scale(picture);
  const float far_end = side.box.to.x - side.pixels(12.0F);
  for (std::size_t i = 0; i < picture.walls.size(); ++i) {
    const PictureWall& wall = picture.walls[i];
    const bool last = i + 1 == picture.walls.size();
    const float face = std::min(side.x_of(wall.face_m), far_end);
    const float end = last ? far_end : std::min(side.x_of(picture.walls[i + 1].face_m), far_end);
    const ImVec4 own = stiffness_colour(side.pen.theme, scale.share(wall.stiffness_n_per_m));
    const PixelBox block{{face, side.y_of(kFilmWallTop)}, {end, side.y_of(kFilmWallFoot)}};
    side.pen.list->AddRectFilled(block.from, block.to,
                                 ImGui::ColorConvertFloat4ToU32(with_alpha(own, kFilmWallAlpha)));
  }
  if (picture.walls.empty()) return;
  const PixelBox all{{side.x_of(picture.walls.front().face_m), side.y_of(kFilmWallTop)},
                     {far_end, side.y_of(kFilmWallFoot)}};
  side.pen.list->AddRect(all.from, all.to, side.pen.theme.packed(side.moment.tone()), 0.0F, 0,
                         side.pixels(2.5F));
}

// A rod with round ends whose tip is at `tip`, in pixels; `longer`: by so much to the left.
PixelBox rod(const SideView& side, float tip, float longer, float half_share) {
  const float length = kFilmHandleLength * side.width() + longer;
  const float middle = side.y_of(kFilmHandleLevel);
  const float half = half_share * side.height();
  return {{tip - length, middle - half}, {tip, middle + half}};
}

void draw_film_handle(const SideView& side) {
  const WallPicture& picture = side.moment.picture;
  const Theme& theme = side.pen.theme;
  const float tip = side.x_of(picture.handle_m.x);
  const float least = side.x_of(picture.handle_m.x - picture.handle_reach_m.below.x);
  const float most = side.x_of(picture.handle_m.x + picture.handle_reach_m.above.x);
  const auto fill = [&](const PixelBox& box, float alpha) {
    side.pen.list->AddRectFilled(box.from, box.to, theme.packed(Tone::kText, alpha),
                                 0.5F * (box.to.y - box.from.y));
  };
  // From where it was furthest out to where it was deepest, then the handle now.
  if (most - least > 0.5F) fill(rod(side, most, most - least, kFilmHandleHalf), kFilmSweptAlpha);
  fill(rod(side, tip, 0.0F, kFilmHandleHalf), 0.92F);
}

// The place that the hand aims at, below the handle; at the edge if it lies beyond.
void draw_hand(const SideView& side) {
  const auto& hand_m = side.moment.picture.hand_m;
  if (!hand_m) return;
  const float edge = side.box.to.x - side.pixels(20.0F);
  const float half = 0.75F * kFilmHandleHalf * side.height();
  const float tip = std::min(side.x_of(hand_m->x), edge);
  const float middle = side.y_of(kFilmHandLevel);
  const float length = side.pixels(84.0F);
  const ImVec2 from(tip - length, middle - half);
  ImDrawList* list = side.pen.list;
  list->PathRect(from, ImVec2(tip, middle + half), half);
  std::vector<ImVec2> outline(list->_Path.begin(), list->_Path.end());
  list->PathClear();
  outline.push_back(outline.front());
  draw_dashed(list, outline, side.pen.theme.packed(Tone::kHand), side.pixels(1.8F), Dash::kDashed,
              side.pen.scale);
  const float width = side.pen.width("hand", kNoteFontSize, nullptr);
  side.pen.text({tip - 0.5F * (length + width), middle - 0.62F * side.pixels(kNoteFontSize)},
                "hand", kNoteFontSize, Tone::kHand);
}

// From the face against the handle; its length is the share of the largest force.
void draw_force(const SideView& side) {
  const WallPicture& picture = side.moment.picture;
  const Theme& theme = side.pen.theme;
  const Tone tone = side.moment.tone();
  const float base = side.x_of(side.moment.scales.face_m) - side.pixels(6.0F);
  const float full = kFilmArrowLength * side.width();
  const float level = side.y_of(kFilmArrowLevel);
  const float half = side.pixels(7.0F);
  const auto end_of = [&](double force_n) {
    const double share = force_share(picture, {force_n, 0.0}).x;
    return base - static_cast<float>(share) * full;
  };
  const SweptForce swept = swept_force(picture);
  const float now = end_of(picture.force_n.x);
  const float most = end_of(swept.most_n.x);
  side.pen.list->AddRectFilled({std::min(most, base), level - half},
                               {std::max(most, base), level + half},
                               theme.packed(tone, kFilmSweptAlpha));
  const float head = std::min(side.pixels(22.0F), std::abs(now - base));
  const float back = now < base ? now + head : now - head;
  side.pen.list->AddRectFilled({std::min(back, base), level - 0.4F * half},
                               {std::max(back, base), level + 0.4F * half}, theme.packed(tone));
  side.pen.list->AddTriangleFilled({now, level}, {back, level - 1.7F * half},
                                   {back, level + 1.7F * half}, theme.packed(tone));
  if (!side.moment.now.scene.x().device.force_limit_n) return;
  const float mark = base - full;
  side.pen.list->AddLine({mark, level - 2.0F * half}, {mark, level + 2.0F * half},
                         theme.packed(Tone::kMuted), side.pixels(2.0F));
  side.pen.text({mark - side.pixels(18.0F), level - 2.0F * half - side.pixels(20.0F)}, "F_max",
                kNoteFontSize, Tone::kMuted);
}

// The name of what the handle touches in the place of walls.
void draw_environment(const SideView& side) {
  if (!side.moment.picture.walls.empty()) return;
  const std::string name(environments()[side.moment.now.scene.environment.index].description.name);
  const float width = side.pen.width(name, kNoteFontSize, nullptr);
  side.pen.text({side.box.to.x - width - side.pixels(12.0F), side.box.from.y + side.pixels(10.0F)},
                name, kNoteFontSize, Tone::kMuted);
}

}  // namespace

void draw_film_wall(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment) {
  const SideView side{pen, box, moment};
  pen.panel(box, Tone::kBackground);
  pen.list->PushClipRect(box.from, box.to, true);
  draw_wall_blocks(side);
  draw_hand(side);
  draw_film_handle(side);
  draw_force(side);
  draw_environment(side);
  const std::string force = force_words(moment.tail);
  if (!force.empty()) {
    const ImVec2 place(box.from.x + side.pixels(12.0F), box.to.y - side.pixels(30.0F));
    pen.text(place, "pushed back by", kNoteFontSize, Tone::kMuted);
    pen.text({place.x + pen.width("pushed back by  ", kNoteFontSize, nullptr), place.y}, force,
             kNoteFontSize, Tone::kText, pen.theme.fonts.strong);
  }
  pen.list->PopClipRect();
}

}  // namespace hapticwall::draw
