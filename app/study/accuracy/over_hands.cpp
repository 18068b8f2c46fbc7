#include "app/study/accuracy/over_hands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/file/text/text.h"
#include "app/study/field.h"
#include "core/units.h"

namespace hapticwall::study::accuracy {
namespace {

using HandsRow = AccuracyHandsRow;

constexpr std::string_view kHandsReference = "exact integrator, the same hand";

constexpr NumberForm kHandsPercents{kPercent, 2};

// "-" if no hand has an amplitude to compare.
std::string within_text(const HandsRow& row) {
  return row.compared == 0 ? "-" : fmt::format("{} of {}", row.within, row.compared);
}

constexpr std::array<Field<HandsRow>, 5> kHandsFields{
    {{"integrator", [](const HandsRow& r) { return json_of(r.integrator); }, "integrator", "",
      kAsIs, nullptr, Align::kLeft},
     {"substeps", [](const HandsRow& r) { return json_of(r.substeps); }, "substeps", ""},
     {"hands_within_one_percent", [](const HandsRow& r) { return json_of(r.within); }, "within 1 %",
      "hands", kAsIs, within_text},
     {"max_relative_error", [](const HandsRow& r) { return json_of(r.max_error); }, "max error",
      "%", kHandsPercents},
     {"verdicts_agree", [](const HandsRow& r) { return json_of(r.verdicts_agree); }, "same verdict",
      "hands"}}};

struct Amplitudes {
  std::optional<double> min_m;
  std::optional<double> max_m;
};

// Of the hands that oscillate with `exact`.
Amplitudes amplitudes_of(const AccuracyHands& measured) {
  Amplitudes found;
  for (const Summary& run : measured.exact) {
    if (run.verdict != Verdict::kOscillating || !run.tail_peak_to_peak_m) continue;
    const double amplitude_m = *run.tail_peak_to_peak_m;
    found.min_m = std::min(found.min_m.value_or(amplitude_m), amplitude_m);
    found.max_m = std::max(found.max_m.value_or(amplitude_m), amplitude_m);
  }
  return found;
}

double stiffness_of(const AccuracyHandsPlan& plan, std::size_t index) {
  return hand_stiffness(plan.scene.x().hand->stiffness_n_per_m, index, plan.hands);
}

Json hands_conditions(const AccuracyHandsPlan& plan, const AccuracyHands& measured) {
  const Amplitudes found = amplitudes_of(measured);
  const Summary& first = measured.exact.front();
  return {{"scene", first.scene},
          {"algorithm", first.algorithm},
          {"duration_s", json_of(first.duration_s)},
          {"hands", plan.hands},
          {"hand_stiffness_from_n_per_m", json_of(stiffness_of(plan, 0))},
          {"hand_stiffness_to_n_per_m", json_of(stiffness_of(plan, plan.hands - 1))},
          {"oscillating_hands", measured.oscillating()},
          {"min_tail_peak_to_peak_m", json_of(found.min_m)},
          {"max_tail_peak_to_peak_m", json_of(found.max_m)}};
}

std::string hands_heading(const AccuracyHandsPlan& plan, const AccuracyHands& measured) {
  const Amplitudes found = amplitudes_of(measured);
  std::string text = fmt::format(
      "{} under {}: {} hands of {:g} to {:g} N/m in equal steps, each against exact\n"
      "exact: {} of them oscillate",
      measured.exact.front().scene, measured.exact.front().algorithm, plan.hands,
      stiffness_of(plan, 0), stiffness_of(plan, plan.hands - 1), measured.oscillating());
  if (!found.min_m) return text + "\n";
  return text + fmt::format(", {} to {} mm peak to peak in the last second (tail)\n",
                            table::fixed(found.min_m, kMillimetresPerMetre, 3),
                            table::fixed(found.max_m, kMillimetresPerMetre, 3));
}

draw::LogSeries series_of_hands(const AccuracyHands& measured, Integrator integrator,
                                draw::Tone tone, draw::Mark mark, bool labels_above) {
  draw::LogSeries series{
      .name = std::string(kIntegratorNames.at(static_cast<std::size_t>(integrator))),
      .tone = tone,
      .mark = mark,
      .radius = 1.0F,
      .labels_above = labels_above,
      .points = {}};
  for (const HandsRow& row : measured.rows) {
    if (row.integrator != integrator || !row.max_error) continue;
    series.points.push_back({.x = static_cast<double>(row.substeps),
                             .y = kPercent * *row.max_error,
                             .label = fmt::format("{}", row.within),
                             .filled = row.within == measured.oscillating()});
  }
  return series;
}

}  // namespace

draw::LogFigure error_over_hands(const AccuracyHandsPlan& plan, const AccuracyHands& measured) {
  draw::LogPlot plot;
  plot.title = "Largest error of the tail's amplitude";
  plot.unit = "%";
  plot.x_title = "substeps a tick";
  plot.goal = 1.0;
  plot.nothing = "no hand oscillates: there is no oscillation to be off from";
  plot.series = {series_of_hands(measured, Integrator::kSemiImplicitEuler, draw::Tone::kForce,
                                 draw::Mark::kCircle, true),
                 series_of_hands(measured, Integrator::kRungeKutta4, draw::Tone::kPosition,
                                 draw::Mark::kSquare, false)};
  const Summary& first = measured.exact.front();
  return {
      .title = fmt::format("{}  ·  {}", first.scene, first.algorithm),
      .subject = fmt::format("accuracy over {} hands", plan.hands),
      .note = fmt::format("reference: the exact integrator with the same hand, {:g} to {:g} N/m",
                          stiffness_of(plan, 0), stiffness_of(plan, plan.hands - 1)),
      .hollow = "not all hands within 1 %",
      .labels = "hands within 1 %",
      .missing = "",
      .plots = {std::move(plot)}};
}

Outcome outcome_of(const AccuracyHandsPlan& plan, const AccuracyHands& measured) {
  Outcome outcome =
      study::outcome_of<HandsRow>(kHandsFields, hands_conditions(plan, measured), measured.rows,
                                  {.only_json = {{"reference", kHandsReference}}});
  outcome.sheet.heading = hands_heading(plan, measured);
  outcome.sheet.marks =
      "errors are relative to the amplitude with exact, of the hands that oscillate with exact\n";
  outcome.figure = error_over_hands(plan, measured);
  return outcome;
}

}  // namespace hapticwall::study::accuracy
