#include "app/command/compare_plot.h"

#include <fmt/format.h>

#include "app/command/run_outputs.h"
#include "app/file/picture.h"
#include "app/file/recording_writer.h"

namespace hapticwall::command {
Failure ComparisonPlot::open(const std::string& path, const Scene& scene, std::size_t runs) {
  if (path.empty()) return {};
  if (runs > ui::kMostComparedRuns) {
    return Error{ErrorKind::kUsage,
                 fmt::format("--plot: a figure shows at most {} algorithms, --algorithms names {}",
                             ui::kMostComparedRuns, runs)};
  }
  ticks_ = scene.tick_count();
  if (ticks_ > kMostPlottedTicks / runs) {
    return Error{ErrorKind::kUsage,
                 fmt::format("--plot: a figure shows at most {} ticks in all, {} of each of {} "
                             "algorithms; this scene has {}; --duration shortens it",
                             kMostPlottedTicks, kMostPlottedTicks / runs, runs, ticks_)};
  }
  return file_.open(path);
}

void ComparisonPlot::begin_run() { histories_.emplace_back(ticks_); }

void ComparisonPlot::take(const Sample& sample) {
  if (file::is_finite(sample)) histories_.back().push(sample);
}

Failure ComparisonPlot::finish(const Scene& scene, const std::vector<Summary>& summaries,
                               const std::vector<std::size_t>& order) {
  if (!is_open()) return {};
  std::vector<ui::ComparedRun> runs;
  runs.reserve(order.size());
  for (const std::size_t i : order) runs.push_back({summaries.at(i), histories_.at(i)});
  const Result<file::Picture> figure =
      ui::draw_comparison(scene, runs, ui::comparison_size(runs.size()));
  if (!figure) return figure.error();
  const Result<std::string> bytes = file::encode_png(*figure);
  if (!bytes) return bytes.error();
  return file_.write_whole(*bytes);
}

}  // namespace hapticwall::command
