#include "app/draw/figure/map_figure.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/symbol_text.h"
#include "app/draw/figure/map_field.h"
#include "app/draw/figure/map_legend.h"
#include "app/draw/figure/page.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {
namespace {

constexpr float kMapGapEms = 1.2F;    // between two fields
constexpr float kFieldShare = 0.82F;  // height of a field's area by its width
constexpr double kMaxFieldMm = 70.0;  // height of a field's area

// "K T²/m from 0.02 to 2"; "" for a number without a dimensionless form.
std::string dimensionless_range(const Scene& scene, const MapAxis& axis, const MapAxis& other) {
  const auto number = dimensionless(scene, axis, other);
  if (!number) return "";
  return fmt::format("  ·  {} from {:.3g} to {:.3g}", number->symbol, axis.low * number->factor,
                     axis.high * number->factor);
}

void draw_title(const Theme& theme, const StabilityMap& map) {
  strong_text(theme, map.scene.name, kTitleFontSize);
  const FontScope font(nullptr, kSmallFontSize);
  wrapped_symbol_text(
      theme.packed(Tone::kMuted),
      fmt::format("stability map, {} × {} runs of {:g} s{}{}{}", map.x.count, map.y.count,
                  map.scene.duration_s, map.algorithms.size() > 1 ? " under each algorithm" : "",
                  dimensionless_range(map.scene, map.x, map.y),
                  dimensionless_range(map.scene, map.y, map.x)));
}

// The fields in rows. Only the first column has labels; all share the titles of the axes.
class FieldGrid {
 public:
  FieldGrid(const MapContents& contents, std::size_t columns)
      : contents_(contents), columns_(columns) {}

  void draw(const Theme& theme) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const std::string up = map_axis_title(contents_.map.y);
    const float title = title_room(up, height_);
    const float gap = ems(kMapGapEms);
    const auto count = static_cast<float>(columns_);
    const float free = ImGui::GetContentRegionAvail().x - title - labels_;
    const float each = (free - gap * count) / count;  // a gap at the right, for the last label
    const float left = corner.x + title;
    MapFieldArea first;
    MapFieldArea last;
    for (std::size_t i = 0; i < contents_.map.algorithms.size(); ++i) {
      const bool starts = i % columns_ == 0;
      if (starts && i > 0) ImGui::SetCursorScreenPos({corner.x, bottom_ + 0.5F * gap});
      if (starts) top_ = ImGui::GetCursorScreenPos().y;
      last = draw_one(theme, i, left, each, gap);
      if (i == 0) first = last;
    }
    ImGui::SetCursorScreenPos({corner.x, bottom_});
    const ImU32 colour = theme.packed(Tone::kText);
    draw_upright_title(colour, up, corner.x, title, first.corner.y,
                       last.corner.y + last.size.y - first.corner.y);
    draw_title_below(colour, map_axis_title(contents_.map.x), left + labels_, count * (each + gap));
    labels_ = std::max(0.0F, labels_ + first.corner.x - (left + labels_));
    heading_ = std::max(0.0F, first_height_ - first.size.y);
    height_ = last.corner.y + last.size.y - first.corner.y;
  }

 private:
  MapFieldArea draw_one(const Theme& theme, std::size_t i, float left, float each, float gap) {
    const auto column = static_cast<float>(i % columns_);
    const float room = column == 0.0F ? labels_ : 0.0F;
    const float area = std::min(kFieldShare * each, pixels_of_mm(kMaxFieldMm));
    const float height = area + heading_;
    ImGui::SetCursorScreenPos({left + labels_ - room + column * (each + gap), top_});
    const MapFieldArea drawn = draw_map_field(theme, contents_, i,
                                              {.size = {each + room, height},
                                               .titles = false,
                                               .value_labels = column == 0.0F,
                                               .labels = room});
    bottom_ = top_ + height;
    if (i == 0) first_height_ = height;
    return drawn;
  }

  const MapContents& contents_;
  std::size_t columns_;
  float labels_ = 0.0F;   // width of the labels, known after one frame
  float heading_ = 0.0F;  // height of a field beside its area, known after one frame
  float first_height_ = 0.0F;
  float height_ = 0.0F;  // of all areas, known after one frame
  float top_ = 0.0F;
  float bottom_ = 0.0F;
};

std::size_t map_columns(const Paper& paper, std::size_t fields) {
  return std::clamp<std::size_t>(fields, 1, paper.narrow() ? 2 : 4);
}

}  // namespace

Result<file::Picture> draw_map(const StabilityMap& map, std::span<const MapMetrics> figures,
                               const Paper& paper) {
  const std::vector<BoundLines> bounds = map_bounds(map);
  const MapContents contents{map, figures, bounds, 0.6F * print_scale()};
  FieldGrid grid(contents, map_columns(paper, map.algorithms.size()));
  return draw_page(paper, [&](const Theme& theme) {
    draw_title(theme, map);
    draw_map_legend(theme, figures, bounds, contents.scale);
    ImGui::Spacing();
    grid.draw(theme);
  });
}

}  // namespace hapticwall::draw
