// What the two export buttons do.
#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <string>

#include "app/file/picture.h"
#include "app/ui/export.h"
#include "app/ui/figure.h"
#include "app/ui/plot_controls.h"
#include "app/ui/replay_state.h"
#include "app/ui/shown_axis.h"
#include "app/ui/toolbar.h"
#include "core/stability_bounds.h"

namespace hapticwall::ui {
namespace {

constexpr FigureSize kFigureSize{1600, 1200};
constexpr FigureSize kFigureSizeWithPlane{2400, 1200};

TimeWindow visible_window(const PanelContext& context) {
  return {context.state.transient.time_from_s, context.state.transient.time_to_s};
}

// What there is of the window: it may reach beyond the samples.
std::string name_of(const PanelContext& context, const SampleHistory& history, IndexRange range) {
  if (range.count() == 0) return export_name(context.session.scene(), 0.0, 0.0);
  return export_name(context.session.scene(), history.value(Quantity::kTime, range.first),
                     history.value(Quantity::kTime, range.last - 1));
}

FigureView figure_view(const PanelContext& context) {
  const PlotsState& plots = context.state.plots;
  FigureView view;
  view.window = visible_window(context);
  view.plots = plots_of(context.state.persisted.arrangement);
  view.lines = plots.persisted.lines;
  view.hidden = context.state.persisted.hidden_lines;
  view.axes = plots.transient.axes;
  if (plots.persisted.show_bounds) view.bounds = bounds_of(context);
  if (!shows_second_axis(context)) view.extra_traces = plots.transient.extra_traces;
  view.marks = {context.session.marks(), context.session.scene().sampling.rate_hz};
  view.phase = plots.persisted.phase;
  return view;
}

// On a thread of its own, because it needs an OpenGL of its own, and this thread's stays current;
// waits for it, because there is one ImGui at a time.
Result<file::Picture> draw_elsewhere(const Scene& scene, const SampleHistory& history,
                                     const FigureView& view) {
  Result<file::Picture> picture = Error{};
  const FigureSize size = view.phase.shown ? kFigureSizeWithPlane : kFigureSize;
  std::async(std::launch::async, [&] { picture = draw_figure(scene, history, view, size); }).get();
  return picture;
}

}  // namespace

std::vector<BoundLine> bounds_of(const PanelContext& context) {
  const Scene scene = shown_scene(context);
  if (scene.walls.empty()) return {};
  const std::size_t wall = std::min(context.state.transient.chosen_wall, scene.walls.size() - 1);
  const double delay_s =
      context.session.device_info().is_simulated ? delay_of(scene) : context.snapshot.link.delay_s;
  return bound_lines(stability_bounds(scene, scene.walls[wall], delay_s));
}

void export_samples(const PanelContext& context, const SampleHistory& history) {
  ExportJob& job = context.state.plots.transient.exporting;
  if (job.running()) return;
  const TimeWindow window = visible_window(context);
  const IndexRange range = history.range_within(window.from_s, window.to_s);
  const bool simulated = knows_truth(context.session);
  const ExportSource source{shown_scene(context), simulated, context.session.device_info().name};
  job.start(history, range, source,
            unused_recording_path(context.state.transient.recording_folder,
                                  name_of(context, history, range)));
}

void notice_exported(const PanelContext& context) {
  const auto outcome = context.state.plots.transient.exporting.take();
  if (!outcome) return;
  if (!outcome->rows) {
    tell(context.state, MessageKind::kProblem, outcome->rows.error().message);
    return;
  }
  tell(context.state, MessageKind::kNote,
       fmt::format("exported {} rows to {}", *outcome->rows, outcome->path));
}

void export_figure(const PanelContext& context, const SampleHistory& history) {
  const TimeWindow window = visible_window(context);
  const std::string path = unused_path(
      context.state.transient.recording_folder,
      name_of(context, history, history.range_within(window.from_s, window.to_s)), ".png");
  const Result<file::Picture> picture =
      draw_elsewhere(shown_scene(context), history, figure_view(context));
  if (!picture) {
    tell(context.state, MessageKind::kProblem, picture.error().message);
  } else if (const Failure failure = file::write_png(path, *picture)) {
    tell(context.state, MessageKind::kProblem, failure->message);
  } else {
    tell(context.state, MessageKind::kNote, "exported the figure to " + path);
  }
}

}  // namespace hapticwall::ui
