#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/study/worst_hand/worst_hand.h"

namespace hapticwall::study::hands {
namespace {

using draw::LogSeries;
using draw::Mark;
using draw::Tone;

constexpr std::array kTones{Tone::kForce, Tone::kPosition, Tone::kStiffness, Tone::kHand,
                            Tone::kHold,  Tone::kText,     Tone::kWallForce};
constexpr std::array kMarks{Mark::kCircle, Mark::kSquare, Mark::kDiamond};

// The largest energy so far; the last, hollow mark is the typical energy of the hand of the table.
LogSeries series_of(const Row& row, std::size_t index) {
  LogSeries series{.name = row.algorithm,
                   .tone = kTones.at(index % kTones.size()),
                   .mark = kMarks.at(index % kMarks.size()),
                   .radius = 0.7F,
                   .labels_above = true,
                   .points = {}};
  for (const worst_hand::Gain& gain : row.found.gains)
    series.points.push_back({static_cast<double>(gain.hand), gain.taken_at_rest_j, "", true});
  if (!row.found.hand) return series;
  series.points.back().label = fmt::format("{:.3g}", row.found.most_j());
  series.points.push_back({static_cast<double>(row.found.hands), row.found.hand->typical_j,
                           fmt::format("{:.3g}", row.found.hand->typical_j), false});
  return series;
}

}  // namespace

draw::LogFigure gains_figure(const worst_hand::Plan& plan, const std::vector<Row>& rows) {
  draw::LogPlot plot;
  plot.title = "Largest energy that a hand took";
  plot.quantity = "energy E";
  plot.unit = "J";
  plot.x_title = "hands tried";
  plot.nothing = "no hand took energy; that proves nothing";
  std::string none;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    plot.series.push_back(series_of(rows[i], i));
    if (!rows[i].found.hand) none += (none.empty() ? "" : ", ") + rows[i].algorithm;
  }
  return {
      .title = plan.scene.name,
      .subject = "a search for a hand that takes energy",
      .note = fmt::format("{}, {} bounds, seed {}, {:g} s each",
                          plan.motion == worst_hand::Motion::kRamp ? "ramps, energy after their end"
                                                                   : "let-go hands",
                          worst_hand::kBoundsNames.at(static_cast<std::size_t>(plan.bounds)),
                          plan.seed, plan.scene.duration_s),
      .hollow = "typical energy of the shown hand, among hands within 1 %",
      .labels = "J",
      .missing = none.empty() ? "" : "no hand found: " + none,
      .plots = {std::move(plot)}};
}

}  // namespace hapticwall::study::hands
