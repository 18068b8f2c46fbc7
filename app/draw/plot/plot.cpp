#include "app/draw/plot/plot.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/ticks.h"
#include "app/draw/plot/plot_heading.h"
#include "app/draw/plot/plot_ranges.h"

namespace hapticwall::draw {
namespace {

constexpr double kMinTimeAxisS = 1e-4;
constexpr double kMaxTimeAxisS = 1e6;
constexpr float kWallLineWeight = 1.5F;  // pixels, at least
constexpr float kDimStrength = 0.4F;     // opacity of a band that must not cover others

// A wheel or drag that began between the axes changes the time axis.
ImPlotAxisFlags value_lock(const PlotSurface& surface, const PlotAxes& axes) {
  if (!surface.interactive) return 0;
  const ImGuiIO& io = ImGui::GetIO();
  const bool selecting =
      io.MouseDown[ImGuiMouseButton_Right] || io.MouseReleased[ImGuiMouseButton_Right];
  const ImVec2 began =
      io.MouseDown[ImGuiMouseButton_Left] ? io.MouseClickedPos[ImGuiMouseButton_Left] : io.MousePos;
  return !selecting && axes.area.contains(began) ? ImPlotAxisFlags_Lock : 0;
}

// Ticks that are chosen for the size of the plot.
void set_up_printed_ticks(const PlotSurface& surface, const PlotDescription& plot,
                          const PlotAxes& axes, ImVec2 size) {
  const TimeWindow& window = *surface.window;
  set_up_ticks(ImAxis_X1, ticks_across(window.from_s, window.to_s, size.x));
  const auto set_up = [&](ImAxis id, const ValueAxis& axis, double knee) {
    // Of labels that do not touch.
    const double gap =
        static_cast<double>(1.1F * ems(1.0F) / size.y) * (axis.maximum - axis.minimum);
    set_up_ticks(id, knee > 0.0 ? symlog_ticks(axis.minimum, axis.maximum, knee, gap)
                                : round_ticks(axis.minimum, axis.maximum, max_ticks_up(size.y)));
  };
  set_up(ImAxis_Y1, axes.left, plot.left.knee);
  if (has_axis(surface, plot, Side::kRight)) set_up(ImAxis_Y2, axes.right, 0.0);
  if (has_axis(surface, plot, Side::kFarRight)) set_up(ImAxis_Y3, axes.far_right, 0.0);
}

void set_up_axes(PlotSurface& surface, const PlotDescription& plot, PlotAxes& axes,
                 double* length_s, ImVec2 size) {
  const auto labels = [](bool shown) { return shown ? 0 : ImPlotAxisFlags_NoTickLabels; };
  const ImPlotAxisFlags lock = value_lock(surface, axes);
  ImPlot::SetupAxis(ImAxis_X1, nullptr, kAxisFlags | labels(surface.time_labels));
  ImPlot::SetupAxisLinks(ImAxis_X1, &surface.window->from_s, &surface.window->to_s);
  ImPlot::SetupAxisZoomConstraints(ImAxis_X1, kMinTimeAxisS, kMaxTimeAxisS);
  ImPlot::SetupAxisFormat(ImAxis_X1, format_time, length_s);
  axes.left.set_up(ImAxis_Y1, "%6.6g", lock | labels(surface.value_labels));
  for (const Side side : kRightSides) {
    if (!has_axis(surface, plot, side)) continue;
    axes.on(side).set_up(value_axis(side), "%.6g",
                         lock | ImPlotAxisFlags_Opposite | ImPlotAxisFlags_NoGridLines);
  }
  if (surface.theme->prints()) set_up_printed_ticks(surface, plot, axes, size);
  ImPlot::SetupFinish();
}

// The wall as the region that it fills: x grows into it.
void draw_walls(const PlotSurface& surface, const PlotDescription& plot) {
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  ImPlot::PushPlotClipRect();
  for (const WallSettings& wall : surface.walls) {
    const double face = wall.position_m * plot.left.scale;
    const ImVec2 face_left = ImPlot::PlotToPixels(limits.X.Min, face);
    const ImVec2 far_right = ImPlot::PlotToPixels(limits.X.Max, std::max(limits.Y.Max, face));
    list->AddRectFilled(ImVec2(face_left.x, far_right.y), ImVec2(far_right.x, face_left.y),
                        surface.theme->packed(Tone::kWall, 0.10F));
    list->AddLine(face_left, ImVec2(far_right.x, face_left.y), surface.theme->packed(Tone::kWall),
                  std::max(kWallLineWeight, 0.8F * surface.line_weight));
  }
  ImPlot::PopPlotClipRect();
}

void draw_zero_line(const PlotSurface& surface) {
  const double zero = 0.0;
  ImPlotSpec spec = line_spec(with_alpha(surface.theme->colour(Tone::kMuted), 0.6F));
  spec.Flags |= ImPlotInfLinesFlags_Horizontal;
  spec.LineWeight = ImGui::GetStyle().FontScaleMain;
  ImPlot::PlotInfLines("##zero", &zero, 1, spec);
}

// No label lies on the line of zero or on the face of a wall.
void take_horizontals(const PlotSurface& surface, const PlotDescription& plot) {
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  const auto take = [&](double value) {
    const std::array line{ImPlot::PlotToPixels(limits.X.Min, value),
                          ImPlot::PlotToPixels(limits.X.Max, value)};
    surface.scratch->ink.take(line, surface.line_weight);
  };
  if (plot.id == PlotId::kPassivity) take(0.0);
  if (plot.id != PlotId::kPosition) return;
  for (const WallSettings& wall : surface.walls) take(wall.position_m * plot.left.scale);
}

// The measured signal has the band, not its truth as well: both would hide each other.
bool has_other_band(const PlotSurface& surface, const PlotDescription& plot, const PlotLine& line) {
  return std::ranges::any_of(plot.lines, [&](const PlotLine& other) {
    return line.measured_as == other.quantity && is_drawn(surface, plot, other);
  });
}

void draw_lines(const PlotSurface& surface, const PlotDescription& plot, IndexRange range) {
  if (range.count() == 0) return;
  const auto drawn = std::ranges::count_if(
      plot.lines, [&](const PlotLine& line) { return is_drawn(surface, plot, line); });
  for (const PlotLine& described : plot.lines) {
    if (!is_drawn(surface, plot, described)) continue;
    const PlotLine line = shown_line(surface, plot, described);
    const ValueScale& scale = plot.scale_of(line);
    TraceStyle style{line.name, surface.theme->colour(line.tone), surface.line_weight, line.dash,
                     scale.smallest_span};
    style.column = surface.column;
    if (surface.line_names && drawn > 1) style.label = line.name;
    if (line.wish || line.side != Side::kLeft) style.band_strength = kDimStrength;
    if (has_other_band(surface, plot, line)) style.band_strength = 0.0F;
    TraceSource source{*surface.history, line.quantity, range, scale.scale};
    source.knee = scale.knee;
    if (line.wish && plot.id == PlotId::kForce && surface.device.force_limit_n)
      source.clip = {-*surface.device.force_limit_n, *surface.device.force_limit_n};
    draw_trace(source, style, value_axis(line.side), *surface.scratch);
  }
  ImPlot::SetAxes(ImAxis_X1, ImAxis_Y1);
}

// The bounds of theory, or the limits of the actuator.
std::vector<BoundLine> bounds_of(const PlotSurface& surface, const PlotDescription& plot) {
  if (plot.id == PlotId::kForce && surface.device.force_limit_n) {
    const double limit_n = *surface.device.force_limit_n;
    return {{"−F_max", -limit_n}, {"F_max", limit_n}};
  }
  const bool shown = surface.show_bounds == nullptr || *surface.show_bounds;
  return plot.id == PlotId::kStiffness && shown ? surface.bounds : std::vector<BoundLine>{};
}

void draw_labels(const PlotSurface& surface, const PlotDescription& plot) {
  const ImVec2 corner = ImPlot::GetPlotPos();
  const ImVec2 size = ImPlot::GetPlotSize();
  ImPlot::PushPlotClipRect();
  draw_line_ends(surface.scratch->ink, {corner, {corner.x + size.x, corner.y + size.y}},
                 ImPlot::GetPlotDrawList());
  ImPlot::PopPlotClipRect();
  draw_bounds(*surface.theme, bounds_of(surface, plot), plot.left.scale, surface.scratch->ink);
}

// The trigger's contact: a small triangle at the top and a faint line.
void draw_contact_mark(const PlotSurface& surface) {
  if (!surface.contact_s) return;
  const ImVec2 top = ImPlot::GetPlotPos();
  const float x = ImPlot::PlotToPixels(*surface.contact_s, 0.0).x;
  const float size = 0.4F * ImGui::GetFontSize();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  ImPlot::PushPlotClipRect();
  list->AddLine(ImVec2(x, top.y), ImVec2(x, top.y + ImPlot::GetPlotSize().y),
                surface.theme->packed(Tone::kWarning, 0.35F));
  list->AddTriangleFilled(ImVec2(x - size, top.y), ImVec2(x + size, top.y),
                          ImVec2(x, top.y + 1.4F * size), surface.theme->packed(Tone::kWarning));
  ImPlot::PopPlotClipRect();
}

// Returns true if the pointer is at one of them.
bool draw_cursors(const PlotSurface& surface) {
  if (surface.cursors == nullptr || !surface.cursors->shown) return false;
  constexpr std::array kNames{"A", "B"};
  bool touched = false;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    bool hovered = false;
    bool held = false;
    double& time_s = surface.cursors->time_s[i];
    ImPlot::DragLineX(static_cast<int>(i), &time_s, surface.theme->colour(Tone::kText), 1.0F,
                      ImPlotDragToolFlags_NoFit, nullptr, &hovered, &held);
    touched = touched || hovered || held;
    const float x = ImPlot::PlotToPixels(time_s, 0.0).x;
    ImPlot::PushPlotClipRect();
    ImPlot::GetPlotDrawList()->AddText(
        ImVec2(x + 0.3F * ImGui::GetFontSize(), ImPlot::GetPlotPos().y),
        surface.theme->packed(Tone::kText), kNames[i]);
    ImPlot::PopPlotClipRect();
  }
  return touched;
}

// Values of all lines at the sample that is nearest to the pointer.
void draw_readout(const PlotSurface& surface, const PlotDescription& plot) {
  if (!surface.interactive || surface.history->empty() || !ImPlot::IsPlotHovered()) return;
  const SampleHistory& history = *surface.history;
  const double pointed_s = ImPlot::GetPlotMousePos().x;
  if (pointed_s < history.oldest_time_s() || pointed_s > history.newest_time_s()) return;
  const std::size_t index = *history.nearest(pointed_s);
  ImGui::BeginTooltip();
  ImGui::PushFont(surface.theme->fonts.digits, kSmallFontSize);
  ImGui::Text("%-20s %10.4f s", "time", history.value(&Sample::time_s, index));
  for (const PlotLine& line : plot.lines) {
    const PlotLine shown = shown_line(surface, plot, line);
    const ValueScale& scale = plot.scale_of(line);
    const double value = history.value(line.quantity, index) * scale.scale;
    if (is_chosen(surface, plot, line) && !std::isnan(value))
      ImGui::TextColored(surface.theme->colour(shown.tone), "%-20s %10.4f %s", shown.name, value,
                         scale.unit);
    draw_extra_readout(surface, plot, line, pointed_s);
  }
  ImGui::PopFont();
  ImGui::EndTooltip();
}

void notice_input(PlotSurface& surface, const PlotDescription& plot, PlotAxes& axes) {
  axes.left.notice_input(ImAxis_Y1);
  for (const Side side : kRightSides) {
    if (has_axis(surface, plot, side)) axes.on(side).notice_input(value_axis(side));
  }
  if (ImPlot::IsPlotHovered()) surface.pointed_s = ImPlot::GetPlotMousePos().x;
  if (!ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return;
  if (ImPlot::IsPlotHovered() || ImPlot::IsAxisHovered(ImAxis_X1)) surface.wants_newest = true;
}

void draw_contents(const PlotSurface& surface, const PlotDescription& plot, IndexRange range) {
  if (plot.id == PlotId::kPosition) draw_walls(surface, plot);
  if (plot.id == PlotId::kPassivity) draw_zero_line(surface);
  surface.scratch->ink.clear();
  take_horizontals(surface, plot);
  draw_extra_traces(surface, plot);
  draw_lines(surface, plot, range);
  draw_labels(surface, plot);
  draw_contact_mark(surface);
  draw_plot_marks(*surface.theme, surface.marks, surface.line_weight);
  if (!draw_cursors(surface)) draw_readout(surface, plot);
}

// The plot at the cursor, without heading and titles. Its area is in `axes` then.
void draw_axes_and_contents(PlotSurface& surface, const PlotDescription& plot, PlotAxes& axes,
                            ImVec2 size) {
  const FontScope font(surface.theme->fonts.digits, kSmallFontSize);
  double length_s = surface.window->length_s();
  const bool visible = ImPlot::BeginPlot(fmt::format("##plot {}", plot.title).c_str(), size,
                                         plot_flags(surface.interactive));
  if (!visible) {
    axes.area = {};
    return;
  }
  const ImVec2 labels(ems(2.0F), surface.time_labels ? ems(1.5F) : 0.0F);  // of the axes, at least
  set_up_axes(surface, plot, axes, &length_s, {size.x - labels.x, size.y - labels.y});
  draw_contents(surface, plot, visible_range(surface));
  if (surface.interactive) notice_input(surface, plot, axes);
  axes.area = {ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
  ImPlot::EndPlot();
}

// The plot with the titles of its axes, within `size`.
void draw_printed(PlotSurface& surface, const PlotDescription& plot, PlotAxes& axes, ImVec2 size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  // Half of the last label of the time axis reaches beyond it.
  const float right = has_axis(surface, plot, Side::kRight) ? 0.0F : 0.8F * ems(1.0F);
  const float below = surface.time_labels ? 1.2F * ems(1.0F) : 0.0F;
  ImGui::SetCursorScreenPos({corner.x + surface.title_room, corner.y});
  draw_axes_and_contents(surface, plot, axes,
                         {size.x - surface.title_room - right, size.y - below});
  const PlotArea& area = axes.area;
  const ImU32 colour = surface.theme->packed(Tone::kText);
  if (surface.title_room > 0.0F)
    draw_upright_title(colour, axis_title(surface, plot), corner.x, surface.title_room,
                       area.position.y, area.size.y);
  ImGui::SetCursorScreenPos({corner.x, corner.y + size.y - below});
  if (surface.time_labels) draw_title_below(colour, "time t (s)", area.position.x, area.size.x);
}

}  // namespace

PlotArea draw_plot(PlotSurface& surface, const PlotDescription& general, const std::string& mark,
                   ImVec2 size) {
  ImGui::PushID(general.title);
  PlotAxes& axes = (*surface.axes)[static_cast<std::size_t>(general.id)];
  const float top = ImGui::GetCursorPosY();
  const IndexRange range = visible_range(surface);
  fit_left_axis(surface, general, axis_values(surface, general, range, Side::kLeft));
  const PlotDescription plot = in_shown_units(surface, general);
  if (surface.heading) {
    draw_plot_heading(surface, plot, mark, hand_outside(surface, plot, axes.left.maximum), size.x);
  }
  for (const Side side : kRightSides) {
    if (has_axis(surface, plot, side))
      axes.on(side).fit(axis_range(axis_values(surface, plot, range, side), plot.scale_of(side)));
  }
  const ImVec2 left(size.x, std::max(1.0F, size.y - (ImGui::GetCursorPosY() - top)));
  if (surface.theme->prints()) {
    draw_printed(surface, plot, axes, left);
  } else {
    draw_axes_and_contents(surface, plot, axes, left);
  }
  ImGui::PopID();
  return axes.area;
}

}  // namespace hapticwall::draw
