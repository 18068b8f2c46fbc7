#include "app/draw/plot/plot_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/draw/plot/plot_heading.h"

namespace hapticwall::draw {
namespace {

// Positions, unlike penetrations, do not begin at the wall.
bool shows_positions(const PlotSurface& surface, const PlotDescription& plot) {
  return std::any_of(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& line) {
    const bool position =
        line.quantity == &Sample::position_m || line.quantity == &PlantTruth::position_m;
    return position && is_drawn(surface, plot, line);
  });
}

// Extremes of the drawn lines: of desired values if `wish`, else of all other lines.
std::optional<Extremes> line_values(const PlotSurface& surface, const PlotDescription& plot,
                                    IndexRange range, Side side, bool wish) {
  std::optional<Extremes> all;
  for (const PlotLine& line : plot.lines) {
    if (line.side != side || line.wish != wish || !is_drawn(surface, plot, line)) continue;
    if (const auto extra = extra_extremes(surface, line)) include(all, *extra);
    if (range.count() == 0) continue;
    const SampleStats stats = surface.history->stats(line.quantity, range);
    if (!stats.empty()) include(all, stats.extremes);
  }
  return all;
}

// The force axis always shows what the actuator can do in the direction of the forces, with room
// for the label of the limit.
void include_limit(const PlotSurface& surface, Extremes& values) {
  // Share of the force limit; a smaller force does not count as a pull.
  constexpr double kPullShare = 0.05;
  constexpr double kRoom = 1.15;
  const double limit_n = surface.device.force_limit_n.value_or(0.0);
  const bool pulls = values.minimum < -kPullShare * limit_n;
  values.include({pulls ? -kRoom * limit_n : 0.0, kRoom * limit_n});
}

}  // namespace

bool has_axis(const PlotSurface& surface, const PlotDescription& plot, Side side) {
  return std::any_of(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& line) {
    return line.side == side && is_drawn(surface, plot, line);
  });
}

IndexRange visible_range(const PlotSurface& surface) {
  return surface.history->range(surface.window->from_s, surface.window->to_s);
}

Extremes axis_values(const PlotSurface& surface, const PlotDescription& plot, IndexRange range,
                     Side side) {
  std::optional<Extremes> all = line_values(surface, plot, range, side, false);
  if (!all) all = line_values(surface, plot, range, side, true);
  if (plot.id != PlotId::kPosition || side != Side::kLeft) {
    include(all, {});
  } else if (!surface.walls.empty() && (!all || shows_positions(surface, plot))) {
    const double face_m = surface.walls.front().position_m;
    include(all, {face_m, face_m});
  }
  if (plot.id == PlotId::kForce && side == Side::kLeft) include_limit(surface, *all);
  return all.value_or(Extremes{});
}

Extremes axis_range(const Extremes& values, const ValueScale& scale) {
  const Extremes shown{scale.on_axis(values.minimum), scale.on_axis(values.maximum)};
  if (scale.knee == 0.0) return round_range(shown, scale.smallest_span);
  constexpr double kDecadeShare = 0.25;  // beyond the values
  return {shown.minimum - kDecadeShare, shown.maximum + kDecadeShare};
}

PlotDescription in_shown_units(const PlotSurface& surface, const PlotDescription& plot) {
  constexpr double kMinCounts = 2.0;
  PlotDescription shown = plot;
  const PlotAxes& axes = (*surface.axes)[static_cast<std::size_t>(plot.id)];
  if (axes.large) shown.left = plot.left_large;
  shown.left.knee = axes.knee;
  if (plot.id == PlotId::kPosition) {
    const double count_m = surface.device.encoder_m.value_or(0.0);
    shown.left.smallest_span =
        std::max(plot.left.smallest_span, kMinCounts * count_m * plot.left.scale);
  }
  return shown;
}

Extremes shown_values(const PlotSurface& surface, const PlotDescription& plot) {
  return axis_values(surface, plot, visible_range(surface), Side::kLeft);
}

void fit_left_axis(const PlotSurface& surface, const PlotDescription& plot, Extremes values) {
  constexpr double kMaxSmall = 1000.0;
  PlotAxes& axes = (*surface.axes)[static_cast<std::size_t>(plot.id)];
  if (axes.left.manual) return;
  const double largest = std::max(std::abs(values.minimum), std::abs(values.maximum));
  axes.large =
      axes.knee == 0.0 && plot.left_large.scale > 0.0 && largest * plot.left.scale >= kMaxSmall;
  axes.left.fit(axis_range(values, in_shown_units(surface, plot).left));
}

std::string axis_title(const PlotSurface& surface, const PlotDescription& plot) {
  const bool other = plot.id == PlotId::kPosition && surface.axis == 1;
  return fmt::format("{} ({})", other ? "position y" : plot.quantity, plot.left.unit);
}

std::string hand_outside(const PlotSurface& surface, const PlotDescription& plot,
                         double axis_maximum) {
  const IndexRange range = visible_range(surface);
  if (plot.id != PlotId::kPosition || range.count() == 0) return {};
  if (!is_drawn(surface, plot, plot.lines.front())) return {};
  const double highest =
      surface.history->extremes(&PlantTruth::hand_path_m, range).maximum * plot.left.scale;
  if (highest <= axis_maximum) return {};
  return fmt::format("hand to {:.1f} {} ↑", highest, plot.left.unit);
}

}  // namespace hapticwall::draw
