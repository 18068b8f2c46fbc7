#include "app/draw/figure/work_precision.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "app/draw/figure/page.h"
#include "app/draw/plot/log_plot.h"
#include "app/draw/plot/theme.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr float kDesignWidth = 1200.0F;  // figure of scale 1
constexpr float kPrecisionDesignHeight = 600.0F;

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

LogPlot plot_of(const AccuracyStudy& study, const char* title, const char* unit, ErrorOf error_of) {
  LogPlot plot;
  plot.title = title;
  plot.unit = unit;
  plot.x_title = "cost, ns per tick";
  plot.nothing = "no run has an error to show";
  for (const SeriesStyle& style : kSeries) {
    plot.series.push_back(series_of(study, style, error_of));
  }
  return plot;
}

std::string reference_text(const Summary& reference) {
  std::string text = fmt::format("reference, the exact propagator in extended precision: {}",
                                 verdict_name(reference.verdict));
  if (reference.diverged_at_tick) {
    text += fmt::format(" at tick {}", *reference.diverged_at_tick);
  } else if (reference.tail_peak_to_peak_m) {
    text += fmt::format(", {:.4g} mm peak to peak in the last second (the tail)",
                        *reference.tail_peak_to_peak_m * kMillimetresPerMetre);
  }
  return text;
}

void draw_title(const Theme& theme, const Scene& scene, const AccuracyStudy& study) {
  strong_text(theme, fmt::format("{}  ·  {}", scene.name, study.reference.algorithm),
              kTitleFontSize);
  ImGui::SameLine();
  ImGui::TextDisabled("  speed against accuracy");
  const FontScope font(nullptr, kSmallFontSize);
  ImGui::TextDisabled("%s", reference_text(study.reference).c_str());
}

void draw_legend(const Theme& theme) {
  const FontScope font(nullptr, kSmallFontSize);
  const float gap = 1.6F * ImGui::GetFontSize();
  for (const SeriesStyle& style : kSeries) {
    draw_legend_mark(theme, style.tone, style.mark, true);
    const std::string name(name_of(style.integrator));
    ImGui::TextColored(theme.colour(style.tone), "%s", name.c_str());
    ImGui::SameLine(0.0F, gap);
  }
  draw_legend_mark(theme, kSeries.front().tone, kSeries.front().mark, false);
  ImGui::TextDisabled("hollow: not the reference's verdict");
  ImGui::SameLine(0.0F, gap);
  ImGui::TextDisabled("numbers: substeps a tick");
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

void draw_work_precision(const Theme& theme, const AccuracyStudy& study, ImVec2 size, float scale) {
  const float top = ImGui::GetCursorPosY();
  draw_legend(theme);
  const std::string diverged = diverged_runs(study);
  if (!diverged.empty()) {
    const FontScope font(nullptr, kSmallFontSize);
    ImGui::TextWrapped("%s", diverged.c_str());
  }
  ImGui::Spacing();
  LogPlot position = plot_of(study, "(a) Largest error of position", "m", position_error_m);
  LogPlot amplitude =
      plot_of(study, "(b) Error of the tail's amplitude", "%", amplitude_error_percent);
  amplitude.goal = 1.0;  // percent: good enough for most
  if (study.reference.verdict == Verdict::kSettled) {
    amplitude.nothing = "the reference is settled: there is no oscillation to be off from";
  }
  const float gap = 3.0F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 half(0.5F * (size.x - gap), size.y - (ImGui::GetCursorPosY() - top));
  draw_log_plot(theme, position, half, scale);
  ImGui::SameLine(0.0F, gap);
  draw_log_plot(theme, amplitude, half, scale);
}

Result<file::Picture> draw_work_precision(const Scene& scene, const AccuracyStudy& study,
                                          FigureSize size) {
  const float scale = std::min(static_cast<float>(size.width) / kDesignWidth,
                               static_cast<float>(size.height) / kPrecisionDesignHeight);
  return draw_page(size, scale, [&](const Theme& theme) {
    draw_title(theme, scene, study);
    draw_work_precision(theme, study, ImGui::GetContentRegionAvail(), scale);
  });
}

}  // namespace hapticwall::draw
