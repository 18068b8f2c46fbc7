#include "app/ui/page/plots_panel.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/page/plot_controls.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/time_view.h"
#include "app/ui/widget/shown_axis.h"

namespace hapticwall::ui {
namespace {

constexpr double kAxisMovedS = 1e-9;  // a smaller move is a rounding error
constexpr float kPlotGapEms = 1.6F;   // gap between two columns of plots
// Share of the width for the phase plane and the table of cursors.
constexpr float kPlaneShare = 0.38F;
constexpr float kMinPlaneEms = 20.0F;
constexpr float kMaxPlaneEms = 34.0F;
constexpr float kTableShare = 0.45F;  // share of the height, below the plane

void set_window(TimeView& time, draw::TimeWindow window) {
  time.from_s = window.from_s;
  time.to_s = window.to_s;
}

// Moves the time axes to the newest samples, or to a contact.
void move_window(PlotsState& state, TimeView& time, const draw::SampleHistory& history) {
  PlotsState::Transient& plots = state.transient;
  const draw::TriggerSettings& settings = state.persisted.trigger;
  const draw::TimeWindow before = time_window(time);
  if (settings.mode == draw::TriggerMode::kOff) {
    follow_newest(time, history.newest_time_s());
  } else {
    if (!plots.was_following) plots.trigger = armed_trigger(settings, history.newest_time_s());
    if (const auto window = run_trigger(history, settings, window_length_s(time), plots.trigger)) {
      set_window(time, *window);
    }
    // A single shot stays, so that it can be examined.
    if (plots.trigger.stage == draw::TriggerStage::kDone) time.follow = false;
  }
  carry_cursors(plots.cursors, before, time_window(time));
}

draw::PlotSurface surface_of(const PanelContext& context, const draw::SampleHistory& history,
                             draw::TimeWindow& window) {
  PlotsState& plots = context.plots;
  draw::PlotSurface surface;
  surface.theme = &context.theme;
  surface.history = &history;
  surface.walls = shown_walls(context);
  surface.window = &window;
  surface.chosen = &plots.persisted.lines;
  surface.hidden = &plots.persisted.hidden_lines;
  surface.axes = &plots.transient.axes;
  surface.scratch = &plots.transient.scratch;
  surface.cursors = &plots.transient.cursors;
  if (plots.persisted.trigger.mode != draw::TriggerMode::kOff)
    surface.contact_s = plots.transient.trigger.contact_s;
  surface.device = shown_device(context);
  surface.bounds = bounds_of(context);
  // Overlays and ghosts belong to axis x.
  if (context.shows.axis == Axis::kX) surface.extra_traces = plots.transient.extra_traces;
  surface.marks = {context.session.marks(), context.session.scene().sampling.rate_hz};
  surface.show_bounds = &plots.persisted.show_bounds;
  surface.show_counts = &plots.persisted.show_counts;
  surface.simulated = context.session.knows_truth();
  surface.line_weight = draw::kLineWeight * ImGui::GetStyle().FontScaleMain;
  return surface;
}

// Two plots make a row, four a square; the three of the paper's figures make a column.
void draw_plots(const PlotsState& state, draw::PlotSurface& surface, const draw::PlotTable& table,
                ImVec2 corner, ImVec2 free) {
  const std::span<const draw::PlotId> plots = plots_of(state.persisted.arrangement);
  const std::size_t columns = plots.size() % 2 == 0 ? 2 : 1;
  const std::size_t whole_rows = (plots.size() + columns - 1) / columns;
  const ImVec2 gap(kPlotGapEms * ImGui::GetFontSize(), ImGui::GetStyle().ItemSpacing.y);
  const auto count = static_cast<float>(columns);
  const auto rows = static_cast<float>(whole_rows);
  const ImVec2 each((free.x - (count - 1.0F) * gap.x) / count,
                    (free.y - (rows - 1.0F) * gap.y) / rows);
  if (!ImPlot::BeginAlignedPlots("plots")) return;  // gives all plots one left and one right margin
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const auto column = static_cast<float>(i % columns);
    const std::size_t row_index = i / columns;
    const auto row = static_cast<float>(row_index);
    ImGui::SetCursorScreenPos(
        ImVec2(corner.x + column * (each.x + gap.x), corner.y + row * (each.y + gap.y)));
    const std::string mark = columns == 1 ? fmt::format("({}) ", static_cast<char>('a' + i)) : "";
    surface.time_labels = i + columns >= plots.size();  // linked axes need them once
    draw_plot(surface, table[plots[i]], mark, each);
  }
  ImPlot::EndAlignedPlots();
}

int side_planes(const PlotsState& plots) {
  return (plots.persisted.phase.shown ? 1 : 0) + (plots.persisted.spectrum.shown ? 1 : 0);
}

// Draws the visible ones from the top: the phase plane, the spectrum, the cursor table.
void draw_side(const PanelContext& context, const draw::PlotSurface& surface,
               const draw::PlotTable& table, ImVec2 corner, ImVec2 size) {
  PlotsState& plots = context.plots;
  const bool cursors = plots.transient.cursors.shown;
  const int planes = side_planes(plots);
  const float each =
      (cursors ? 1.0F - kTableShare : 1.0F) * size.y / static_cast<float>(std::max(planes, 1));
  const auto next = [&] { ImGui::SetCursorScreenPos(corner); };
  next();
  if (plots.persisted.phase.shown) {
    draw_phase_plot(surface, plots.persisted.phase, plots.transient.phase, ImVec2(size.x, each));
    corner.y += each;
    next();
  }
  if (plots.persisted.spectrum.shown) {
    draw_spectrum_plot(surface, table, plots.persisted.spectrum, plots.transient.spectrum,
                       ImVec2(size.x, each));
    corner.y += each;
    next();
  }
  if (!cursors) return;
  ImGui::BeginChild("cursor table", ImVec2(size.x, 0.0F), 0, ImGuiWindowFlags_HorizontalScrollbar);
  draw_cursor_table(
      context.theme,
      read_cursors(*surface.history, plots.transient.cursors, plots_of(plots.persisted.arrangement),
                   plots.persisted.lines, plots.persisted.hidden_lines, surface.simulated, table));
  ImGui::EndChild();
}

}  // namespace

void draw_plots_panel(const PanelContext& context, const draw::SampleHistory& history) {
  PlotsState& plots = context.plots;
  TimeView& time = context.time;
  notice_exported(context);
  draw_plot_controls(context, history);
  const bool following = time.follow;
  if (following) move_window(plots, time, history);
  plots.transient.was_following = following;

  const draw::TimeWindow before = time_window(time);
  draw::TimeWindow window = before;
  draw::PlotSurface surface = surface_of(context, history, window);
  const draw::PlotTable table(history.signals());
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImVec2 free = ImGui::GetContentRegionAvail();
  if (side_planes(plots) > 0 || plots.transient.cursors.shown) {
    const float side =
        std::clamp(kPlaneShare * free.x, draw::ems(kMinPlaneEms), draw::ems(kMaxPlaneEms));
    draw_side(context, surface, table, ImVec2(corner.x + free.x - side, corner.y),
              ImVec2(side, free.y));
    free.x -= side + draw::ems(kPlotGapEms);
  }
  draw_plots(plots, surface, table, corner, free);
  set_window(time, window);
  // Dragging an axis stops following.
  if (std::abs(window.from_s - before.from_s) > kAxisMovedS ||
      std::abs(window.to_s - before.to_s) > kAxisMovedS) {
    time.follow = false;
  }
  if (surface.wants_newest) time.follow = true;
  time.looked_at_s = following ? std::nullopt : surface.pointed_s;
}

}  // namespace hapticwall::ui
