#include "app/draw/figure/log_figure.h"

#include <imgui.h>

#include "app/draw/axis/symbol_text.h"
#include "app/draw/figure/page.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

constexpr double kLogPlotMm = 64.0;  // height of a plot
constexpr float kLogScale = 0.6F;    // of lines and marks, by that of the text

void draw_log_heading(const Theme& theme, const LogFigure& figure) {
  strong_text(theme, figure.title, kTitleFontSize);
  const FontScope font(nullptr, kSmallFontSize);
  wrapped_symbol_text(theme.packed(Tone::kMuted), figure.subject + "  ·  " + figure.note);
}

}  // namespace

Result<file::Picture> draw_log_page(const LogFigure& figure, const Paper& paper) {
  return draw_page(paper, [&](const Theme& theme) {
    draw_log_heading(theme, figure);
    draw_log_legend(theme, figure);
    ImGui::Spacing();
    const auto count = paper.narrow() ? 1.0F : static_cast<float>(figure.plots.size());
    const float gap = 2.0F * ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - (count - 1.0F) * gap) / count;
    for (const LogPlot& plot : figure.plots) {
      if (!paper.narrow() && &plot != figure.plots.data()) ImGui::SameLine(0.0F, gap);
      draw_log_plot(theme, plot, {width, pixels_of_mm(kLogPlotMm)}, kLogScale * print_scale());
    }
  });
}

}  // namespace hapticwall::draw
