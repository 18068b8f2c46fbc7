#include "app/draw/plot/dashes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

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

// Where the pen is in the pattern.
struct Pen {
  Pattern pattern;
  std::size_t part = 0;
  float left = 0.0F;  // of the part

  [[nodiscard]] bool down() const { return part % 2 == 0; }
  void move(float length) {
    left -= length;
    if (left > 0.0F) return;
    part = (part + 1) % pattern.size();
    left = pattern[part];
  }
};

}  // namespace

void draw_dashed(ImDrawList* list, std::span<const ImVec2> points, ImU32 colour, float weight,
                 Dash dash, float scale) {
  Pen pen{pattern_of(dash, scale)};
  pen.left = pen.pattern.front();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ImVec2 from = points[i - 1];
    const ImVec2 way(points[i].x - from.x, points[i].y - from.y);
    const float length = std::hypot(way.x, way.y);
    const auto at = [&](float done) {
      return ImVec2(from.x + done / length * way.x, from.y + done / length * way.y);
    };
    for (float done = 0.0F; done < length;) {  // never for a gap
      const float step = std::min(pen.left, length - done);
      if (pen.down()) list->AddLine(at(done), at(done + step), colour, weight);
      // A step that is lost in rounding would never end.
      done = done + step > done ? done + step : length;
      pen.move(step);
    }
  }
}

}  // namespace hapticwall::draw
