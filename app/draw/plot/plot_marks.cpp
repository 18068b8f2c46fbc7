#include "app/draw/plot/plot_marks.h"

#include <implot.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hapticwall::draw {
namespace {

constexpr float kMarkAlpha = 0.75F;
constexpr float kThin = 0.65F;  // relative to a line of the session
constexpr float kMarkGapEms = 0.3F;
constexpr float kMinEms = 1.5F;  // the shortest text that is drawn

// Draws a text from `left`, cut off at `right`.
void draw_text(const Theme& theme, const std::string& text, float left, float right) {
  const float gap = kMarkGapEms * ImGui::GetFontSize();
  if (text.empty() || right - left < kMinEms * ImGui::GetFontSize()) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float top = ImPlot::GetPlotPos().y + gap;
  const float height = ImGui::GetFontSize();
  const float end = std::min(right, left + ImGui::CalcTextSize(text.c_str()).x + 2.0F * gap);
  list->PushClipRect(ImVec2(left, top), ImVec2(end, top + height + gap), true);
  list->AddRectFilled(ImVec2(left, top), ImVec2(end, top + height + gap),
                      theme.packed(Tone::kBackground, 0.75F));
  list->AddText(ImVec2(left + gap, top), theme.packed(Tone::kWarning), text.c_str());
  list->PopClipRect();
}

}  // namespace

void draw_plot_marks(const Theme& theme, const PlotMarks& marks, float line_weight) {
  if (marks.list.empty()) return;
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  const ImVec2 corner = ImPlot::GetPlotPos();
  const ImVec2 size = ImPlot::GetPlotSize();
  const auto time_of = [&](const file::Mark& mark) {
    return static_cast<double>(mark.tick) / marks.rate_hz;
  };
  const auto first = std::lower_bound(
      marks.list.begin(), marks.list.end(), limits.X.Min,
      [&](const file::Mark& mark, double time_s) { return time_of(mark) < time_s; });
  const float width = std::max(1.0F, std::round(kThin * line_weight));
  ImPlot::PushPlotClipRect();
  for (auto mark = first; mark != marks.list.end() && time_of(*mark) <= limits.X.Max; ++mark) {
    const float x = ImPlot::PlotToPixels(time_of(*mark), 0.0).x;
    const auto next = mark + 1;
    const float right = corner.x + size.x;
    const float room_to = next == marks.list.end()
                              ? right
                              : std::min(right, ImPlot::PlotToPixels(time_of(*next), 0.0).x);
    // Whole pixels keep the line thin and sharp.
    const float left = std::floor(x - 0.5F * width);
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(left, corner.y),
                                              ImVec2(left + width, corner.y + size.y),
                                              theme.packed(Tone::kWarning, kMarkAlpha));
    draw_text(theme, mark->text, x + width, room_to);
  }
  ImPlot::PopPlotClipRect();
}

}  // namespace hapticwall::draw
