#include "app/draw/figure/log_figure.h"

#include <imgui.h>

#include <algorithm>

#include "app/draw/figure/page.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

constexpr float kLogDesignWidth = 1200.0F;  // page of scale 1
constexpr float kLogDesignHeight = 600.0F;

void draw_log_heading(const Theme& theme, const LogFigure& figure) {
  strong_text(theme, figure.title, kTitleFontSize);
  ImGui::SameLine();
  ImGui::TextDisabled("  %s", figure.subject.c_str());
  const FontScope font(nullptr, kSmallFontSize);
  ImGui::TextDisabled("%s", figure.note.c_str());
}

}  // namespace

Result<file::Picture> draw_log_page(const LogFigure& figure, FigureSize size) {
  const float scale = std::min(static_cast<float>(size.width) / kLogDesignWidth,
                               static_cast<float>(size.height) / kLogDesignHeight);
  return draw_page(size, scale, [&](const Theme& theme) {
    draw_log_heading(theme, figure);
    draw_log_figure(theme, figure, ImGui::GetContentRegionAvail(), scale);
  });
}

}  // namespace hapticwall::draw
