// hapticwall compare SCENE: runs one scene under every algorithm and prints one table.
#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/compare/compare_order.h"
#include "app/command/compare/hand_search.h"
#include "app/command/device_choice.h"
#include "app/command/output_file.h"
#include "app/command/recorded_hand.h"
#include "app/command/report/expectation.h"
#include "app/command/report/summary_fields.h"
#include "app/command/report/summary_table.h"
#include "app/command/report/terminal.h"
#include "app/command/run/headless.h"
#include "app/command/signals.h"
#include "app/draw/figure/comparison_figure.h"
#include "app/file/recording/recording_reader.h"
#include "app/study/studies.h"
#include "core/algorithm/algorithm.h"
#include "core/result.h"

namespace hapticwall::command {
namespace {

struct CompareOptions {
  SceneOptions scene;
  OutputOptions output;
  std::vector<std::string> algorithms;  // empty: all
  std::string sort;
  std::string hands;       // "all" or names; empty: the scene's own hand
  std::string worst_hand;  // hands of a search under each row; "": none
  bool study = false;
};

Failure check_plot(const OutputOptions& options, const Scene& scene, std::size_t runs) {
  if (options.plot.empty()) return {};
  if (runs > draw::kMaxComparedRuns) {
    return usage_error(fmt::format("--plot: a figure shows at most {} rows, --algorithms gives {}",
                                   draw::kMaxComparedRuns, runs));
  }
  const std::uint64_t ticks = scene.tick_count();
  if (ticks <= kMaxPlottedTicks / runs) return {};
  return usage_error(fmt::format(
      "--plot: a figure shows at most {} ticks in all, {} of each of {} rows; this scene has "
      "{}; --duration shortens it",
      kMaxPlottedTicks, kMaxPlottedTicks / runs, runs, ticks));
}

struct Runs {
  std::vector<RunSummary> summaries;           // summaries in the order of --algorithms
  std::vector<draw::SampleHistory> histories;  // samples of axis x, for --plot
};

// The scene, or the recording whose hand every row re-runs.
struct Compared {
  file::LoadedScene loaded;
  std::optional<OpenedRecording> recording;
};

Result<Compared> load_compared(const SceneOptions& options, bool quiet) {
  if (!file::is_recording(options.scene)) {
    Result<file::LoadedScene> loaded = load_for_study("compare", options, quiet);
    if (!loaded) return loaded.error();
    return Compared{std::move(*loaded), std::nullopt};
  }
  if (Failure failed = check_simulator("compare", options.device)) return *failed;
  Result<OpenedRecording> opened = open_for_rerun(options, !quiet);
  if (!opened) return opened.error();
  return Compared{opened->loaded, std::move(*opened)};
}

// nullopt if a signal ended it early.
Result<std::optional<RunSummary>> run_row(Compared& from, const ComparedAlgorithm& row,
                                          const std::function<void(const Tick&)>& on_tick,
                                          std::string label, bool shows_progress) {
  if (from.recording) {
    Progress progress(std::move(label), shows_progress);
    Result<std::optional<Summary>> summary = rerun_row(*from.recording, row, on_tick, progress);
    if (!summary) return summary.error();
    if (!*summary) return std::optional<RunSummary>();
    return std::optional(RunSummary{std::move(**summary)});
  }
  from.loaded.scene.algorithm = row.settings;
  HeadlessResult result = simulate_timed({.scene = from.loaded.scene,
                                          .changes = {},
                                          .on_tick = on_tick,
                                          .should_stop = {},
                                          .progress_label = std::move(label),
                                          .show_progress = shows_progress});
  if (result.stopped_early) return std::optional<RunSummary>();
  return std::optional(std::move(result.summary));
}

// nullopt if a signal ended it early.
Result<std::optional<Runs>> run_all(Compared& from, const std::vector<ComparedAlgorithm>& compared,
                                    const OutputOptions& options) {
  const Scene& scene = from.loaded.scene;
  Runs runs;
  std::function<void(const Tick&)> on_tick;
  if (!options.plot.empty()) {
    on_tick = [&](const Tick& tick) {
      if (is_finite(tick.x())) runs.histories.back().push(tick.x());
    };
  }
  for (const ComparedAlgorithm& row : compared) {
    if (on_tick) runs.histories.emplace_back(scene.tick_count(), scene.x().device.encoder_m);
    Result<std::optional<RunSummary>> summary =
        run_row(from, row, on_tick,
                fmt::format("{} {}/{}", row.label, runs.summaries.size() + 1, compared.size()),
                !options.quiet);
    if (!summary) return summary.error();
    if (!*summary) return std::optional<Runs>();
    for (Summary& axis : **summary) axis.algorithm = row.label;
    runs.summaries.push_back(std::move(**summary));
  }
  return std::optional(std::move(runs));
}

// The table and the figure follow `order`; CSV and JSON follow --algorithms.
Failure write_results(OutputFiles& files, const Scene& scene, const Runs& runs,
                      const std::vector<std::size_t>& order) {
  std::vector<RunSummary> rows;
  rows.reserve(order.size());
  for (const std::size_t i : order) rows.push_back(runs.summaries[i]);
  return files.write(
      {summaries_csv(runs.summaries), summaries_json(runs.summaries), comparison_table(rows)},
      [&](const draw::Paper& paper) {
        std::vector<draw::ComparedRun> compared;
        compared.reserve(order.size());
        for (const std::size_t i : order) {
          compared.push_back({runs.summaries[i].front(), runs.histories[i]});
        }
        return draw::draw_comparison(scene, compared, paper);
      });
}

// Runs a study in the place of the comparison.
Result<int> run_instead(const study::Study& study, std::string_view option,
                        const CompareOptions& options, study::Choices choices) {
  if (!options.sort.empty()) {
    return usage_error(
        fmt::format("--sort: not with {}; its rows keep the order of --algorithms", option));
  }
  if (!options.output.plot.empty()) {
    return usage_error(
        fmt::format("--plot: not with {}, which draws no figure; use 'hapticwall run SCENE --plot "
                    "FILE.png'",
                    option));
  }
  // Names the unknown algorithm and the known ones.
  if (const auto known = chosen_algorithms(options.algorithms); !known) return known.error();
  choices["algorithms"] = fmt::format("{}", fmt::join(options.algorithms, ","));
  return run_study(study, "compare", option, options.scene, options.output, choices);
}

// Drops the algorithms that do not run in the scene's environment, with a note; one that was named
// is refused.
Failure drop_refused(const Scene& scene, bool named, std::vector<ComparedAlgorithm>& compared) {
  std::vector<ComparedAlgorithm> kept;
  for (ComparedAlgorithm& row : compared) {
    Scene under = scene;
    under.algorithm = row.settings;
    const auto problem = validate(under);
    if (problem && named) return usage_error(problem->message);
    if (problem) tell(fmt::format("note: left out: {}", problem->message));
    if (!problem) kept.push_back(std::move(row));
  }
  compared = std::move(kept);
  return {};
}

Result<int> compare(const CompareOptions& options) {
  const bool named_hands = !options.hands.empty();
  if (options.study && named_hands) return usage_error("--hands: not with --study");
  if (named_hands && !options.worst_hand.empty())
    return usage_error("--hands: not with --worst-hand");
  if (options.study) {
    return run_instead(study::ranking_study(), "--study", options,
                       {{"worst-hand", options.worst_hand}});
  }
  if (named_hands)
    return run_instead(study::named_hands_study(), "--hands", options, {{"hands", options.hands}});
  const Result<std::vector<Expectation>> expectations =
      parse_expectations(options.output.expectations);
  if (!expectations) return expectations.error();
  const Result<RowOrder> order = parse_order(options.sort);
  if (!order) return order.error();
  if (Failure failed = check_outputs(
          options.output, {options.scene.scene, sidecar_read_with(options.scene.scene)})) {
    return *failed;
  }
  const Result<std::vector<std::size_t>> indices = chosen_algorithms(options.algorithms);
  if (!indices) return indices.error();
  if (Failure failed = check_searched_hands(options.worst_hand)) return *failed;
  Result<Compared> from = load_compared(options.scene, options.output.quiet);
  if (!from) return from.error();
  const Scene& scene = from->loaded.scene;
  auto compared = compared_algorithms(scene.algorithm, *indices);
  if (Failure failed = drop_refused(scene, !options.algorithms.empty(), compared)) return *failed;
  if (!options.worst_hand.empty()) {
    if (Failure failed = check_hand_search(scene, from->recording.has_value())) return *failed;
  }
  if (Failure failed = check_plot(options.output, scene, compared.size())) return *failed;
  if (Failure failed = check_scene_files(options.output, from->loaded)) return *failed;
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  Result<std::optional<Runs>> runs = run_all(*from, compared, options.output);
  if (!runs) return runs.error();
  const bool searched = *runs && search_hands({scene, options.worst_hand, !options.output.quiet},
                                              compared, (*runs)->summaries);
  if (!searched) return ended_early();
  const std::vector<std::size_t> rows = ordered((*runs)->summaries, *order);
  if (Failure failed = write_results(*files, scene, **runs, rows)) return *failed;
  return judge(*expectations, (*runs)->summaries);
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
  app->add_flag("--study", options->study, std::string(study::ranking_study().help));
  app->add_option("--hands", options->hands, std::string(study::named_hands_study().help))
      ->type_name("all|NAME,...");
  app->add_option("--worst-hand", options->worst_hand,
                  "Also search as many hands for one that takes energy, under each row")
      ->type_name("HANDS");
  add_csv_option(*app, options->output, "Write the table as CSV, one line per row");
  add_plot_option(*app, options->output, "Draw all runs side by side");
  app->add_option("--sort", options->sort,
                  "Order of the printed rows: a key of the summary, -KEY for descending order, or "
                  "none for the order of --algorithms")
      ->type_name("KEY");
  add_output_options(*app, options->output);
  return {app, [options] { return compare(*options); }};
}

}  // namespace hapticwall::command
