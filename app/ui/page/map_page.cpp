#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/draw/figure/map_field.h"
#include "app/draw/figure/map_legend.h"
#include "app/draw/verdict/tail.h"
#include "app/file/text/number_name.h"
#include "app/ui/page/map_controls.h"
#include "app/ui/page/map_state.h"
#include "app/ui/page/pages.h"
#include "app/ui/state/model_runs.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kControlsShare = 0.4F;  // share of the width
constexpr float kMinControlsEms = 15.0F;
constexpr float kMaxControlsEms = 21.0F;
constexpr float kGapEms = 1.0F;
constexpr float kDotEms = 0.36F;

// A value in steps of its axis; NaN for a value that the axis cannot have.
float steps_of(const MapAxis& axis, double value) {
  const double part = axis.logarithmic ? std::log(value / axis.low) / std::log(axis.high / axis.low)
                                       : (value - axis.low) / (axis.high - axis.low);
  return static_cast<float>(part * static_cast<double>(axis.count - 1));
}

ImVec2 pixel_of(const StabilityMap& map, const draw::MapFieldArea& area, float x, float y) {
  constexpr float kHalf = 0.5F;
  return {area.corner.x + area.size.x * (x + kHalf) / static_cast<float>(map.x.count),
          area.corner.y + area.size.y * (1.0F - (y + kHalf) / static_cast<float>(map.y.count))};
}

std::size_t cell_at(const StabilityMap& map, const draw::MapFieldArea& area, std::size_t algorithm,
                    ImVec2 pixel) {
  const auto index = [](float share, std::size_t count) {
    const auto cells = static_cast<float>(count);
    return static_cast<std::size_t>(std::clamp(share * cells, 0.0F, cells - 1.0F));
  };
  const std::size_t x = index((pixel.x - area.corner.x) / area.size.x, map.x.count);
  const std::size_t y = index(1.0F - (pixel.y - area.corner.y) / area.size.y, map.y.count);
  return (algorithm * map.y.count + y) * map.x.count + x;
}

// The running scene: a ring that is seen on every colour.
void draw_dot(const PanelContext& context, const StabilityMap& map,
              const draw::MapFieldArea& area) {
  const Scene& scene = context.session.scene();
  const auto x = map.x.number.get(scene);
  const auto y = map.y.number.get(scene);
  if (!x || !y) return;
  const ImVec2 at = pixel_of(map, area, steps_of(map.x, *x), steps_of(map.y, *y));
  const ImVec2 end(area.corner.x + area.size.x, area.corner.y + area.size.y);
  if (!(at.x >= area.corner.x && at.x <= end.x && at.y >= area.corner.y && at.y <= end.y)) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float radius = ems(kDotEms);
  list.AddCircleFilled(at, radius, IM_COL32(255, 255, 255, 255));
  list.AddCircle(at, radius, IM_COL32(0, 0, 0, 255), 0, 0.4F * radius);
  list.AddCircleFilled(at, 0.35F * radius, IM_COL32(0, 0, 0, 255));
}

std::string value_text(const MapAxis& axis, std::size_t index) {
  const file::NumberName name = file::number_name(axis.number);
  return fmt::format("{}: {:.4g} {}", name.name, axis.value(index) * name.scale, name.unit);
}

std::string cell_text(const MapPicture& picture, std::size_t cell) {
  const StabilityMap& map = picture.map();
  const MapPlace at = map.place(cell);
  const MapMetrics& metrics = picture.figures()[cell];
  Summary summary;
  summary.verdict = metrics.verdict;
  summary.tail_peak_to_peak_m = metrics.tail_peak_to_peak_m;
  summary.tail_force_mean_n = metrics.tail_force_mean_n;
  summary.tail_force_std_n = metrics.tail_force_std_n;
  summary.displayed_stiffness_n_per_m = metrics.displayed_stiffness_n_per_m;
  return fmt::format("{}\n{}\n{}", draw::figures_text(summary), value_text(map.x, at.x),
                     value_text(map.y, at.y));
}

// The pointer over a field: figures of the cell, and a click that makes it the running scene.
void use_field(const PanelContext& context, const MapPicture& picture, const StabilityMap& map,
               std::size_t algorithm, const draw::MapFieldArea& area) {
  if (area.size.x <= 0.0F || area.size.y <= 0.0F) return;
  ImGui::SetCursorScreenPos(area.corner);
  const bool clicked =
      ImGui::InvisibleButton(fmt::format("##map cells {}", algorithm).c_str(), area.size);
  draw_dot(context, map, area);
  if (!ImGui::IsItemHovered()) return;
  const std::size_t pointed = cell_at(picture.map(), area, algorithm, ImGui::GetIO().MousePos);
  const std::size_t cell = picture.source(pointed);
  const bool current = same_cells(picture.map(), map);
  std::string text = cell_text(picture, cell);
  if (!current) {
    text += "\nof the scene before; the new map is being computed";
  } else if (context.shows.live != nullptr) {
    text += "\nclick: this becomes the running scene; Reset runs it from rest, as the map did";
  }
  ImGui::SetTooltip("%s", text.c_str());
  if (clicked && current) make_running(context, map.scene_at(cell));
}

void draw_progress(const PanelContext& context, const LiveMap& live, const StabilityMap& map) {
  const std::string runs =
      map.algorithms.size() > 1
          ? fmt::format("{} × {} × {}", map.algorithms.size(), map.y.count, map.x.count)
          : fmt::format("{} × {}", map.y.count, map.x.count);
  const std::string text = live.complete()
                               ? runs + " runs, complete"
                               : fmt::format("{} runs, {:.0f} %", runs, 100.0 * live.fraction());
  progress_bar(context, live.fraction(), text);
  explain(
      "Each cell is a run of the scene from rest, as of 'hapticwall map'. It is computed beside "
      "the session, coarse first, on all cores but one.");
}

void draw_note(const PanelContext& context) {
  if (context.shows.replay != nullptr) {
    muted_text(context,
               "Of the recording's scene at this moment. A recording does not change: a click does "
               "nothing.");
  } else if (context.session.scene().two_axes()) {
    muted_text(context, "Of axis x alone.");
  }
}

// A drag of a slider does not restart a picture before its first stage is done.
void compute(LiveMap& live, const StabilityMap& map) {
  live.take();
  if (scene_in_motion() && live.running() && !live.up_to_date()) return;
  live.ask_for(map);
}

float line_scale() { return ImGui::GetFontSize() / draw::kFontSize; }

void draw_map_keys(const PanelContext& context, const MapPicture* picture) {
  if (picture == nullptr) return;
  ImGui::Spacing();
  draw::draw_map_legend(context.theme, picture->figures(), picture->bounds, line_scale());
}

void draw_picture(const PanelContext& context, const LiveMap& live, const StabilityMap& map) {
  if (!live.problem().empty()) {
    return draw::wrapped_text(context.theme.colour(draw::Tone::kBad), live.problem());
  }
  if (live.picture() == nullptr) return muted_text(context, "computing …");
  const MapPicture& picture = *live.picture();
  draw::draw_map_fields(context.theme,
                        {picture.map(), picture.figures(), picture.bounds, line_scale()},
                        [&](std::size_t algorithm, const draw::MapFieldArea& area) {
                          use_field(context, picture, map, algorithm, area);
                        });
}

}  // namespace

void draw_map_page(const PanelContext& context, MapState& state) {
  if (const std::string why = why_no_runs(context); !why.empty()) {
    state.live.stop();
    return muted_text(context, why);
  }
  const StabilityMap map = map_of(state.choice, context.session.scene());
  compute(state.live, map);
  const float width = std::clamp(kControlsShare * ImGui::GetContentRegionAvail().x,
                                 ems(kMinControlsEms), ems(kMaxControlsEms));
  ImGui::BeginChild("map choices", ImVec2(width, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_progress(context, state.live, map);
  draw_note(context);
  draw_map_controls(context, state.choice, map);
  draw_map_keys(context, state.live.picture());
  ImGui::EndChild();
  ImGui::SameLine(0.0F, ems(kGapEms));
  ImGui::BeginChild("map", ImVec2(0.0F, 0.0F), ImGuiChildFlags_None, ImGuiWindowFlags_NoBackground);
  draw_picture(context, state.live, map);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
