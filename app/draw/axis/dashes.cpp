#include "app/draw/axis/dashes.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace hapticwall::draw {
namespace {

// Lengths in pixels at scale 1: drawn, left out, drawn, left out.
using Pattern = std::array<float, 4>;

Pattern pattern_of(Dash dash, float scale) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  Pattern pattern{kEndless, 0.0F, kEndless, 0.0F};
  if (dash == Dash::kDashed) pattern = {7.0F, 4.0F, 7.0F, 4.0F};
  if (dash == Dash::kDotted) pattern = {2.0F, 4.0F, 2.0F, 4.0F};
  if (dash == Dash::kDashDot) pattern = {9.0F, 3.0F, 2.0F, 3.0F};
  for (float& length : pattern) length *= scale;
  return pattern;
}

// Position of the pen in the pattern.
struct Pen {
  Pattern pattern;
  std::size_t part = 0;
  float left = 0.0F;  // length that is left of the part

  [[nodiscard]] bool down() const { return part % 2 == 0; }
  void move(float length) {
    left -= length;
    if (left > 0.0F) return;
    part = (part + 1) % pattern.size();
    left = pattern[part];
  }
};

// A stroke of two triangles, smoothed by the texture of the font's atlas; AddLine takes six.
// Without anti-aliasing it has exact edges.
class Stroke {
 public:
  Stroke(ImDrawList* list, ImU32 colour, float weight)
      : list_(list),
        colour_(colour),
        half_(0.5F * std::max(weight, 1.0F)),
        upper_(list->_Data->TexUvWhitePixel),
        lower_(upper_) {
    if ((list->Flags & ImDrawListFlags_AntiAliasedLines) == 0) return;
    half_ += 1.0F;
    const float row = std::clamp(weight, 1.0F, static_cast<float>(IM_DRAWLIST_TEX_LINES_WIDTH_MAX));
    const ImVec4 edges = list->_Data->TexUvLines[static_cast<int>(row)];
    upper_ = {edges.x, edges.y};
    lower_ = {edges.z, edges.w};
  }
  // `along`: of length 1.
  void draw(ImVec2 from, ImVec2 to, ImVec2 along) const {
    const ImVec2 side(half_ * along.y, -half_ * along.x);
    list_->PrimReserve(6, 4);
    list_->PrimQuadUV({from.x + side.x, from.y + side.y}, {to.x + side.x, to.y + side.y},
                      {to.x - side.x, to.y - side.y}, {from.x - side.x, from.y - side.y}, upper_,
                      upper_, lower_, lower_, colour_);
  }

 private:
  ImDrawList* list_;
  ImU32 colour_;
  float half_;
  ImVec2 upper_;
  ImVec2 lower_;
};

float cross(ImVec2 a, ImVec2 b) { return a.x * b.y - a.y * b.x; }
float dot(ImVec2 a, ImVec2 b) { return a.x * b.x + a.y * b.y; }

// The directions from a point in which all its followers are passed closely.
class Cone {
 public:
  explicit Cone(ImVec2 tip) : tip_(tip) {}

  // Continues to `point`, which reaches() has accepted; `tip` itself is the first.
  void take(ImVec2 point) {
    way_ = way_to(point);
    const float squared = dot(way_, way_);
    if (squared <= kClose * kClose) return;
    const float along = std::sqrt(squared - kClose * kClose);
    const ImVec2 low(along * way_.x + kClose * way_.y, along * way_.y - kClose * way_.x);
    const ImVec2 high(along * way_.x - kClose * way_.y, along * way_.y + kClose * way_.x);
    if (open_ || cross(low_, low) > 0.0F) low_ = low;
    if (open_ || cross(high_, high) < 0.0F) high_ = high;
    open_ = false;
  }
  // Continues straight at least as far as the newest follower. Never makes a gap.
  [[nodiscard]] bool reaches(ImVec2 point) const {
    const ImVec2 way = way_to(point);
    return dot(way, way_) >= dot(way_, way_) &&
           (open_ || (cross(low_, way) >= 0.0F && cross(way, high_) >= 0.0F));
  }

 private:
  static constexpr float kClose = 0.2F;  // pixels

  [[nodiscard]] ImVec2 way_to(ImVec2 point) const { return {point.x - tip_.x, point.y - tip_.y}; }

  ImVec2 tip_;
  ImVec2 way_;  // path to the newest follower
  ImVec2 low_;
  ImVec2 high_;
  bool open_ = true;  // all directions
};

}  // namespace

void keep_bends(std::vector<ImVec2>& points) {
  std::size_t kept = 0;
  std::optional<Cone> cone;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cone && i + 1 < points.size() && !std::isnan(points[i].y)) {
      cone->take(points[i]);
      if (cone->reaches(points[i + 1])) continue;
    }
    cone.emplace(points[i]);
    points[kept++] = points[i];
  }
  points.resize(kept);
}

void draw_dashed(ImDrawList* list, std::span<const ImVec2> points, ImU32 colour, float weight,
                 Dash dash, float scale) {
  const Stroke stroke(list, colour, weight);
  Pen pen{pattern_of(dash, scale)};
  pen.left = pen.pattern.front();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ImVec2 from = points[i - 1];
    const ImVec2 way(points[i].x - from.x, points[i].y - from.y);
    const float length = std::sqrt(dot(way, way));
    const ImVec2 along(way.x / length, way.y / length);
    const auto at = [&](float done) {
      return ImVec2(from.x + done * along.x, from.y + done * along.y);
    };
    for (float done = 0.0F; done < length;) {  // never for a gap
      const float step = std::min(pen.left, length - done);
      if (pen.down()) stroke.draw(at(done), at(done + step), along);
      // A step that is lost in rounding would never end.
      done = done + step > done ? done + step : length;
      pen.move(step);
    }
  }
}

}  // namespace hapticwall::draw
