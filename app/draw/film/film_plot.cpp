#include <fmt/format.h>
#include <implot.h>

#include "app/draw/film/film_card.h"
#include "app/draw/plot/plot_axes.h"
#include "app/draw/plot/plot_bounds.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr float kFilmLineWeight = 2.6F;  // pixels at scale 1

struct FilmLine {
  const char* title;
  const char* unit;
  Quantity quantity;
  double scale;  // factor from SI values to `unit`
  Extremes range;
};

FilmLine film_line(const FilmMoment& moment, FilmPlot plot) {
  if (plot == FilmPlot::kForce) return {"Force", "N", &Sample::force_n, 1.0, moment.scales.force_n};
  return {"Position", "mm", &PlantTruth::position_m, kMillimetresPerMetre, moment.scales.contact_m};
}

void draw_film_walls(const FilmPen& pen, const FilmMoment& moment) {
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  for (const PictureWall& wall : moment.picture.walls) {
    const double face = wall.face_m * kMillimetresPerMetre;
    const ImVec2 left = ImPlot::PlotToPixels(limits.X.Min, face);
    const ImVec2 right = ImPlot::PlotToPixels(limits.X.Max, limits.Y.Max);
    list->AddRectFilled({left.x, right.y}, {right.x, left.y}, pen.theme.packed(Tone::kWall, 0.16F));
    list->AddLine(left, {right.x, left.y}, pen.theme.packed(Tone::kWall), 1.5F * pen.scale);
  }
}

void draw_film_line(const FilmPen& pen, const FilmMoment& moment, const FilmLine& what,
                    PlotScratch& scratch) {
  const SampleHistory& history = moment.run.history;
  const IndexRange range = history.range(moment.time_s - kFilmWindowS, moment.time_s);
  if (range.count() == 0) return;
  TraceStyle style{what.title, pen.theme.colour(moment.tone()), kFilmLineWeight * pen.scale};
  draw_trace({history, what.quantity, range, what.scale}, style, ImAxis_Y1, scratch);
}

void draw_film_limit(const FilmPen& pen, const FilmMoment& moment, PlotScratch& scratch) {
  const auto& limit_n = moment.now.scene.x().device.force_limit_n;
  if (limit_n) draw_bounds(pen.theme, {{"F_max", *limit_n}}, 1.0, scratch.ink);
}

}  // namespace

void draw_film_plot(const FilmPen& pen, const PixelBox& box, const FilmMoment& moment,
                    FilmPlot plot, PlotScratch& scratch) {
  const FilmLine what = film_line(moment, plot);
  pen.text(box.from, what.title, kNoteFontSize, Tone::kText, pen.theme.fonts.strong);
  const float title = pen.width(what.title, kNoteFontSize, pen.theme.fonts.strong);
  pen.text({box.from.x + title + 8.0F * pen.scale, box.from.y},
           fmt::format("{}, last {:g} s", what.unit, kFilmWindowS), kNoteFontSize, Tone::kMuted);
  const float heading = 1.5F * kNoteFontSize * pen.scale;
  ImGui::SetCursorScreenPos({box.from.x, box.from.y + heading});
  const FontScope font(pen.theme.fonts.text, kSmallFontSize);
  const ImVec2 size(box.to.x - box.from.x, box.to.y - box.from.y - heading);
  if (!ImPlot::BeginPlot(what.title, size, plot_flags(false))) return;
  ImPlot::SetupAxis(ImAxis_X1, nullptr, kAxisFlags | ImPlotAxisFlags_NoTickLabels);
  ImPlot::SetupAxisLimits(ImAxis_X1, moment.time_s - kFilmWindowS, moment.time_s,
                          ImPlotCond_Always);
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, kAxisFlags);
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%g");
  ImPlot::SetupAxisLimits(ImAxis_Y1, what.range.minimum * what.scale,
                          what.range.maximum * what.scale, ImPlotCond_Always);
  ImPlot::SetupFinish();
  scratch.ink.clear();
  ImPlot::PushPlotClipRect();
  if (plot == FilmPlot::kPosition) draw_film_walls(pen, moment);
  ImPlot::PopPlotClipRect();
  draw_film_line(pen, moment, what, scratch);
  if (plot == FilmPlot::kForce) draw_film_limit(pen, moment, scratch);
  ImPlot::EndPlot();
}

}  // namespace hapticwall::draw
