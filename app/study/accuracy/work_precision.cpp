#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/draw/plot/log_plot.h"
#include "app/file/text/verdict.h"
#include "app/study/accuracy/accuracy.h"
#include "core/units.h"

namespace hapticwall::study::accuracy {
namespace {

using draw::LogPlot;
using draw::LogSeries;
using draw::Mark;
using draw::Tone;

struct SeriesStyle {
  Integrator integrator;
  Tone tone;
  Mark mark;
  float radius;
  bool labels_above;
};
constexpr std::array<SeriesStyle, 3> kSeries{
    {{Integrator::kSemiImplicitEuler, Tone::kForce, Mark::kCircle, 1.0F, true},
     {Integrator::kRungeKutta4, Tone::kPosition, Mark::kSquare, 1.0F, false},
     {Integrator::kExact, Tone::kGood, Mark::kDiamond, 1.7F, true}}};

std::string_view name_of(Integrator integrator) {
  return kIntegratorNames.at(static_cast<std::size_t>(integrator));
}

using ErrorOf = std::optional<double> (*)(const AccuracyRow&);

std::optional<double> position_error_m(const AccuracyRow& row) { return row.max_position_error_m; }

std::optional<double> amplitude_error_percent(const AccuracyRow& row) {
  if (!row.tail_peak_to_peak_relative_error) return {};
  return kPercent * std::abs(*row.tail_peak_to_peak_relative_error);
}

LogSeries series_of(const AccuracyStudy& study, const SeriesStyle& style, ErrorOf error_of) {
  LogSeries series{.name = std::string(name_of(style.integrator)),
                   .tone = style.tone,
                   .mark = style.mark,
                   .radius = style.radius,
                   .labels_above = style.labels_above,
                   .points = {}};
  for (const AccuracyRow& row : study.rows) {
    const std::optional<double> error = error_of(row);
    if (row.integrator != style.integrator || !error || !std::isfinite(*error)) continue;
    if (!row.ns_per_tick || !(*row.ns_per_tick > 0.0)) continue;
    series.points.push_back({.x = *row.ns_per_tick,
                             .y = *error,
                             .label = row.substeps ? fmt::format("{}", *row.substeps) : series.name,
                             .filled = row.verdict_agrees});
  }
  return series;
}

LogPlot plot_of(const AccuracyStudy& study, ErrorOf error_of) {
  LogPlot plot;
  plot.x_title = "cost (ns per tick)";
  plot.nothing = "no run has an error to show";
  for (const SeriesStyle& style : kSeries) {
    plot.series.push_back(series_of(study, style, error_of));
  }
  return plot;
}

// The reference in one line, without a line end.
std::string reference_text(const Summary& reference) {
  std::string text = fmt::format("reference, the exact propagator in extended precision: {}",
                                 file::verdict_text(reference));
  if (!reference.diverged_at_tick && reference.tail_peak_to_peak_m) {
    text += fmt::format(", {:.4g} mm peak to peak in the last second (the tail)",
                        *reference.tail_peak_to_peak_m * kMillimetresPerMetre);
  }
  return text;
}

// Names the runs that the plots cannot show; empty without any.
std::string diverged_runs(const AccuracyStudy& study) {
  std::string text;
  for (const AccuracyRow& row : study.rows) {
    if (row.verdict != Verdict::kDiverged) continue;
    text +=
        fmt::format("{}{}", text.empty() ? "diverged, not shown: " : ", ", name_of(row.integrator));
    if (row.substeps) text += fmt::format(" {}", *row.substeps);
  }
  return text;
}

}  // namespace

draw::LogFigure work_precision(const AccuracyStudy& study) {
  LogPlot position = plot_of(study, position_error_m);
  position.title = "(a) Largest error of position";
  position.quantity = "largest error |Δx|";
  position.unit = "m";
  LogPlot amplitude = plot_of(study, amplitude_error_percent);
  amplitude.title = "(b) Error of the tail's amplitude";
  amplitude.quantity = "amplitude error";
  amplitude.unit = "%";
  amplitude.goal = 1.0;  // percent: good enough for most
  if (study.reference.verdict != Verdict::kOscillating) {
    amplitude.nothing = "the reference does not oscillate: there is no oscillation to be off from";
  }
  return {.title = fmt::format("{}  ·  {}", study.reference.scene, study.reference.algorithm),
          .subject = "speed against accuracy",
          .note = reference_text(study.reference),
          .hollow = "not the reference's verdict",
          .labels = "substeps a tick",
          .missing = diverged_runs(study),
          .plots = {std::move(position), std::move(amplitude)}};
}

}  // namespace hapticwall::study::accuracy
