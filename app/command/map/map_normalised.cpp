#include <fmt/format.h>

#include "app/command/map/map.h"
#include "app/command/map/map_report.h"
#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/draw/figure/normalised_figure.h"
#include "core/result.h"
#include "core/study/normalised_chart.h"

namespace hapticwall::command {

Result<int> run_normalised(const MapOptions& options, const Scene& scene) {
  NormalisedChart chart = chart_of_theory(scene);
  if (Failure failed = invalid_cell(validate(chart))) return *failed;
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  {
    Progress progress(fmt::format("chart of {}", scene.name), !options.output.quiet);
    if (!simulate_points(chart, {.should_stop = [] { return stop_signal() != 0; },
                                 .progress = [&](double done) { progress.show(done); }})) {
      return ended_early();
    }
  }
  return status_of(files->write(
      {normalised_csv(chart), normalised_json(chart), normalised_table(chart)},
      [&](draw::Ink ink) { return draw::draw_normalised(chart, draw::kNormalisedSize.in(ink)); }));
}

}  // namespace hapticwall::command
