#include "app/draw/wall/wall_trail.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "app/draw/axis/dashes.h"

namespace hapticwall::draw {
namespace {

// Draws one quantity against its age, in pieces that fade with age.
void draw_trail_line(const Strip& strip, const Trace& trace, double newest_s, ImVec4 colour,
                     bool steps, ImDrawList* list) {
  constexpr double kPieces = 10.0;
  constexpr float kNewestAlpha = 0.95F;
  const float height = strip.to.y - strip.trail_from();
  const auto age = [&](std::size_t i) { return (newest_s - trace.time_s[i]) / kTrailS; };
  const auto level = [&](double share) {
    return strip.trail_from() + height * static_cast<float>(share);
  };
  std::vector<ImVec2> points;
  std::size_t i = trace.time_s.size();
  while (i > 1) {
    const double piece = std::floor(std::max(age(i - 1), 0.0) * kPieces);
    points.assign(1, ImVec2(strip.x_of(trace.value[i - 1]), level(age(i - 1))));
    // A piece ends with the first point of the next one, so that there is no gap.
    while (i > 1) {
      --i;
      const float x = strip.x_of(trace.value[i - 1]);
      if (steps) points.emplace_back(strip.x_of(trace.value[i]), level(age(i - 1)));
      points.emplace_back(x, level(age(i - 1)));
      if (age(i - 1) * kPieces >= piece + 1.0) break;
    }
    const auto faded = static_cast<float>(1.0 - std::min(piece / kPieces, 1.0));
    keep_bends(points);
    draw_dashed(list, points,
                ImGui::ColorConvertFloat4ToU32(with_alpha(colour, kNewestAlpha * faded)), 1.5F,
                Dash::kSolid, 1.0F);
  }
}

}  // namespace

void draw_trail(const Theme& theme, const Strip& strip, const StripTrail& trail, Trace& scratch,
                ImDrawList* list) {
  const SampleHistory& history = trail.history;
  const IndexRange recent = history.range(trail.newest_s - kTrailS, trail.newest_s);
  if (recent.count() < 2) return;
  const auto rows = static_cast<std::size_t>(std::max(strip.to.y - strip.trail_from(), 1.0F));
  const auto draw = [&](Quantity quantity, Tone tone, bool steps) {
    history.decimate(quantity, recent, rows, 1.0, scratch);
    draw_trail_line(strip, scratch, trail.newest_s, theme.colour(tone), steps, list);
  };
  if (trail.with_measured) draw(&Sample::position_m, Tone::kPosition, true);
  draw(&PlantTruth::position_m, Tone::kText, false);
}

}  // namespace hapticwall::draw
