// Exports of the plots.
#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <string>

#include "app/draw/figure/figure.h"
#include "app/file/picture.h"
#include "app/ui/page/plot_controls.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/state/export.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/recording_wishes.h"
#include "app/ui/state/time_view.h"
#include "app/ui/widget/shown_axis.h"

namespace hapticwall::ui {
namespace {

// The window may reach beyond the samples.
std::string name_of(const PanelContext& context, const draw::SampleHistory& history,
                    draw::IndexRange range) {
  if (range.count() == 0) return export_name(context.session.scene(), 0.0, 0.0);
  return export_name(context.session.scene(), history.value(&Sample::time_s, range.first),
                     history.value(&Sample::time_s, range.last - 1));
}

draw::FigureView figure_view(const PanelContext& context) {
  const PlotsState& plots = context.plots;
  draw::FigureView view;
  view.window = time_window(context.time);
  view.plots = plots_of(context.plots.persisted.arrangement);
  view.lines = plots.persisted.lines;
  view.hidden = context.plots.persisted.hidden_lines;
  view.axes = plots.transient.axes;
  if (plots.persisted.show_bounds) view.bounds = bounds_of(context);
  if (context.shows.axis == Axis::kX) view.extra_traces = plots.transient.extra_traces;
  view.marks = {context.session.marks(), context.session.scene().sampling.rate_hz};
  view.axis = static_cast<std::size_t>(context.shows.axis);
  view.phase = plots.persisted.phase;
  return view;
}

// Runs on its own thread, because it needs its own OpenGL context. Waits for it, because there is
// only one ImGui context.
Result<file::Picture> draw_elsewhere(const Scene& scene, const draw::SampleHistory& history,
                                     const draw::FigureView& view) {
  Result<file::Picture> picture = Error{};
  std::async(std::launch::async, [&] { picture = draw_figure(scene, history, view); }).get();
  return picture;
}

}  // namespace

std::vector<draw::BoundLine> bounds_of(const PanelContext& context) {
  const Scene scene = shown_scene(context);
  if (scene.x().walls.empty()) return {};
  const std::size_t wall = std::min(context.selection.wall, scene.x().walls.size() - 1);
  return draw::bound_lines(shown_bounds(context, scene.x().walls[wall]));
}

void export_samples(const PanelContext& context, const draw::SampleHistory& history) {
  ExportJob& job = context.plots.transient.exporting;
  if (job.running()) return;
  const draw::TimeWindow window = time_window(context.time);
  const draw::IndexRange range = history.range_within(window.from_s, window.to_s);
  const bool simulated = context.session.knows_truth();
  const ExportSource source{shown_scene(context), simulated, context.session.device_info().name};
  job.start(history, range, source,
            unused_recording_path(context.recording.folder, name_of(context, history, range)));
}

void notice_exported(const PanelContext& context) {
  const auto outcome = context.plots.transient.exporting.take();
  if (!outcome) return;
  if (!outcome->rows) return tell(context.toasts, outcome->rows.error());
  context.toasts.tell(MessageKind::kNote,
                      fmt::format("exported {} rows to {}", *outcome->rows, outcome->path));
}

void export_figure(const PanelContext& context, const draw::SampleHistory& history) {
  const draw::TimeWindow window = time_window(context.time);
  const std::string path = unused_path(
      context.recording.folder,
      name_of(context, history, history.range_within(window.from_s, window.to_s)), ".png");
  const Result<file::Picture> picture =
      draw_elsewhere(shown_scene(context), history, figure_view(context));
  if (!picture) return tell(context.toasts, picture.error());
  tell(context.toasts, file::write_png(path, *picture), "exported the figure to " + path);
}

}  // namespace hapticwall::ui
