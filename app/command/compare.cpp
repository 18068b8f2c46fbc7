// hapticwall compare SCENE: the same scene under every algorithm, one table.
#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/compare_order.h"
#include "app/command/compare_plot.h"
#include "app/command/compare_study.h"
#include "app/command/device_choice.h"
#include "app/command/headless.h"
#include "app/command/output_file.h"
#include "app/command/signals.h"
#include "app/command/summary_fields.h"
#include "app/command/summary_table.h"
#include "app/command/terminal.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::command {
namespace {

struct CompareOptions {
  SceneOptions scene;
  OutputOptions output;
  std::vector<std::string> algorithms;  // empty: all
  std::string sort;
  bool study = false;
};

// All are opened before anything runs.
struct CompareFiles {
  OutputFile csv;
  OutputFile json;
  ComparisonPlot plot;

  [[nodiscard]] Failure open(const OutputOptions& options, const Scene& scene, std::size_t runs) {
    if (Failure failed = plot.open(options.plot, scene, runs)) return failed;
    if (Failure failed = csv.open(options.csv)) return failed;
    return json.open(options.json);
  }
};

// People read the table and the figure in `order`; scripts rely on that of --algorithms.
Failure write_results(const OutputOptions& options, CompareFiles& files, const Scene& scene,
                      const std::vector<Summary>& summaries,
                      const std::vector<std::size_t>& order) {
  if (Failure failed = files.csv.write_whole(summaries_csv(summaries))) return failed;
  if (Failure failed = files.json.write_whole(summaries_json(summaries))) return failed;
  if (Failure failed = files.plot.finish(scene, summaries, order)) return failed;
  if (options.json == kStandardOutput) return write_output(summaries_json(summaries));
  if (options.quiet) return {};
  std::vector<Summary> rows;
  rows.reserve(order.size());
  for (const std::size_t i : order) rows.push_back(summaries[i]);
  return write_output(comparison_table(rows));
}

// Nothing where a signal ended it early.
std::optional<std::vector<Summary>> run_all(file::LoadedScene loaded,
                                            const std::vector<std::size_t>& indices, bool quiet,
                                            ComparisonPlot& plot) {
  std::vector<Summary> summaries;
  std::function<void(const Sample&, const Sample&)> on_sample;
  if (plot.is_open()) on_sample = [&plot](const Sample& x, const Sample&) { plot.take(x); };
  for (const std::size_t index : indices) {
    loaded.scene.algorithm.index = index;
    if (plot.is_open()) plot.begin_run();
    const SimulationResult result =
        simulate_timed({.scene = loaded.scene,
                        .changes = {},
                        .on_sample = on_sample,
                        .should_stop = {},
                        .progress_label = fmt::format("{} {}/{}", algorithms()[index].name,
                                                      summaries.size() + 1, indices.size()),
                        .show_progress = !quiet});
    if (result.stopped_early) return std::nullopt;
    summaries.push_back(result.summary);
  }
  return summaries;
}

int compare(const CompareOptions& options) {
  if (options.study && !options.sort.empty()) {
    return report({ErrorKind::kUsage, "--sort: not with --study, whose rows stand as they are"});
  }
  if (options.study) return compare_study(options.scene, options.output, options.algorithms);
  const Result<std::vector<Expectation>> expectations =
      parse_expectations(options.output.expectations);
  if (!expectations) return report(expectations.error());
  const Result<RowOrder> order = parse_order(options.sort);
  if (!order) return report(order.error());
  if (const Failure failed = check_outputs(options.output, {options.scene.scene}))
    return report(*failed);
  const Result<std::vector<std::size_t>> indices = chosen_algorithms(options.algorithms);
  if (!indices) return report(indices.error());
  if (const Failure failed = check_simulator("compare", options.scene.device))
    return report(*failed);
  const Result<file::LoadedScene> loaded = load_headless(options.scene);
  if (!loaded) return report(loaded.error());
  if (const Failure failed = check_unchanging("compare", options.scene, *loaded))
    return report(*failed);
  catch_stop_signals();
  CompareFiles files;
  if (const Failure failed = files.open(options.output, loaded->scene, indices->size()))
    return report(*failed);
  const std::optional<std::vector<Summary>> summaries =
      run_all(*loaded, *indices, options.output.quiet, files.plot);
  if (!summaries) {
    tell(fmt::format("ended early by {}; nothing was written", signal_name(stop_signal())));
    return signal_exit_status(stop_signal());
  }
  if (const Failure failed = write_results(options.output, files, loaded->scene, *summaries,
                                           ordered(*summaries, *order)))
    return report(*failed);
  return judge(*expectations, *summaries);
}

}  // namespace

Command add_compare(CLI::App& program) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* app =
      program.add_subcommand("compare", "Run a scene under every algorithm and print one table");
  add_headless_options(*app, options->scene);
  add_algorithms_option(*app, options->algorithms);
  add_scene_options(*app, options->scene);
  add_simulator_option(*app, options->scene);
  app->add_flag(
      "--study", options->study,
      "Instead: largest stable stiffness, rate-hardness, rise time, deepest point, energy "
      "to the hand");
  app->add_option("--csv", options->output.csv, "Write the table as CSV, a line an algorithm")
      ->type_name("FILE");
  app->add_option("--plot", options->output.plot,
                  "Draw all runs beside each other; needs no display")
      ->type_name("FILE.png");
  app->add_option("--sort", options->sort,
                  "Order of the printed rows: by a key of the summary, -KEY for the largest first, "
                  "or none, as --algorithms has them")
      ->type_name("KEY");
  add_output_options(*app, options->output);
  return {app, [options] { return compare(*options); }};
}

}  // namespace hapticwall::command
