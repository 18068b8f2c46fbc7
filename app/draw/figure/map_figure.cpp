#include "app/draw/figure/map_figure.h"

#include <imgui.h>

#include <vector>

#include "app/draw/figure/map_field.h"
#include "app/draw/figure/page.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

constexpr float kMapDesignHeight = 1000.0F;  // px, at figure scale 1

void draw_contents(const Theme& theme, const MapContents& contents) {
  const StabilityMap& map = contents.map;
  strong_text(theme, map.scene.name, kTitleFontSize);
  ImGui::SameLine();
  ImGui::TextDisabled("  stability map, %zu x %zu runs of %g s under each algorithm", map.x.count,
                      map.y.count, map.scene.duration_s);
  draw_map_legend(contents.bounds, contents.scale);
  ImGui::Spacing();
  draw_map_fields(theme, contents);
}

}  // namespace

Result<file::Picture> draw_map(const StabilityMap& map, std::span<const MapMetrics> figures,
                               FigureSize size) {
  const std::vector<BoundLines> bounds = map_bounds(map);
  const float scale = static_cast<float>(size.height) / kMapDesignHeight;
  return draw_page(size, scale, [&](const Theme& theme) {
    draw_contents(theme, {map, figures, bounds, scale});
  });
}

}  // namespace hapticwall::draw
