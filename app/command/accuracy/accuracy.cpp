// hapticwall accuracy SCENE: speed and accuracy of every integrator and substep count.
#include "core/study/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/draw/figure/work_precision.h"
#include "app/file/text/text.h"
#include "app/runtime/loop/realtime_setup.h"
#include "app/table/accuracy_report.h"
#include "core/result.h"

namespace hapticwall::command {
namespace {

std::string usual_substeps() { return fmt::format("{}", fmt::join(kUsualSubsteps, ",")); }

struct CommandOptions {
  SceneOptions scene;
  OutputOptions output;
  std::string substeps = usual_substeps();
};

// Ascending, without duplicates.
Result<std::vector<int>> parse_substeps(const std::string& text) {
  std::vector<int> counts;
  for (const std::string_view part : file::split(text, ',')) {
    const std::optional<int> count = file::parsed<int>(part);
    if (!count || *count < 1 || *count > kMaxSubsteps) {
      return usage_error(
          fmt::format("--substeps {}: it takes whole numbers from 1 to {}, separated by commas",
                      file::in_quotes(text), kMaxSubsteps));
    }
    counts.push_back(*count);
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

AccuracyStudy measure(const Scene& scene, std::vector<int> substeps, bool quiet) {
  Progress progress(scene.name, !quiet);
  AccuracyOptions options;
  options.substeps = std::move(substeps);
  options.now_ns = runtime::thread_processor_time_ns;
  options.should_stop = [] { return stop_signal() != 0; };
  options.on_progress = [&](double done) { progress.show(done); };
  return measure_accuracy(scene, options);
}

Result<int> accuracy(const CommandOptions& options) {
  if (!options.output.expectations.empty()) {
    return usage_error(
        "--expect: 'accuracy' has no single summary; use 'hapticwall run SCENE --expect EXPR' with "
        "--set simulator.integrator=NAME");
  }
  if (Failure failed = check_outputs(options.output,
                                     {options.scene.scene, sidecar_read_with(options.scene.scene)}))
    return *failed;
  Result<std::vector<int>> substeps = parse_substeps(options.substeps);
  if (!substeps) return substeps.error();
  const Result<file::LoadedScene> loaded =
      load_for_study("accuracy", options.scene, options.output.quiet);
  if (!loaded) return loaded.error();
  const Scene& scene = loaded->scene;
  if (Failure failed = check_scene_files(options.output, *loaded)) return *failed;
  if (scene.tick_count() > kMaxAccuracyTicks) {
    return usage_error(fmt::format(
        "accuracy: it takes at most {} ticks, this scene has {}; --duration shortens it",
        kMaxAccuracyTicks, scene.tick_count()));
  }
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  const AccuracyStudy study = measure(scene, std::move(*substeps), options.output.quiet);
  if (study.stopped_early) return ended_early();
  return status_of(files->write({table::accuracy_csv(study), table::accuracy_json(study),
                                 table::sheet_text(table::accuracy_sheet(study))},
                                [&](draw::Ink ink) {
                                  return draw::draw_work_precision(
                                      scene, study, draw::kWorkPrecisionSize.in(ink));
                                }));
}

}  // namespace

Command add_accuracy(CLI::App& program) {
  const auto options = std::make_shared<CommandOptions>();
  CLI::App* app = program.add_subcommand(
      "accuracy", "Measure speed and accuracy of every integrator and substep count");
  add_headless_options(*app, options->scene);
  add_algorithm_option(*app, options->scene);
  add_scene_options(*app, options->scene);
  add_simulator_option(*app, options->scene);
  app->add_option(
         "--substeps", options->substeps,
         fmt::format("Substeps per tick, 1 to {}; default {}", kMaxSubsteps, usual_substeps()))
      ->type_name("N,N,...");
  add_csv_option(*app, options->output, "Write the table as CSV, one line per measurement");
  add_plot_option(*app, options->output, "Draw error over cost (work-precision diagram)");
  add_output_options(*app, options->output);
  app->get_option("--json")->description("Write the study as JSON; - is standard output");
  // Hidden: the error message says which command has it.
  app->get_option("--expect")->group("");
  return {app, [options] { return accuracy(*options); }};
}

}  // namespace hapticwall::command
