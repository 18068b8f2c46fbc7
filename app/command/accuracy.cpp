// hapticwall accuracy SCENE: speed against accuracy, every integrator and substep count on one
// scene.
#include "core/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/command/accuracy_report.h"
#include "app/command/commands.h"
#include "app/command/common_options.h"
#include "app/command/device_choice.h"
#include "app/command/output_file.h"
#include "app/command/processor_time.h"
#include "app/command/progress.h"
#include "app/command/signals.h"
#include "app/command/terminal.h"
#include "app/file/picture.h"
#include "app/file/text.h"
#include "app/ui/work_precision.h"

namespace hapticwall::command {
namespace {

constexpr const char* kDefaultSubsteps = "1,2,5,10,20,50,100,200,500,1000";

struct CommandOptions {
  SceneOptions scene;
  OutputOptions output;
  std::string substeps = kDefaultSubsteps;
};

struct AccuracyFiles {
  OutputFile csv;
  OutputFile json;
  OutputFile plot;
};

// Ascending, each count once.
Result<std::vector<int>> parse_substeps(const std::string& text) {
  const Error wrong{
      ErrorKind::kUsage,
      fmt::format("--substeps {}: it takes whole numbers from 1 to {}, separated by commas",
                  file::in_quotes(text), kMaximumSubsteps)};
  std::vector<int> counts;
  const char* next = text.data();
  const char* end = text.data() + text.size();
  while (true) {
    int count = 0;
    const auto [rest, code] = std::from_chars(next, end, count);
    if (code != std::errc{} || count < 1 || count > kMaximumSubsteps) return wrong;
    counts.push_back(count);
    if (rest == end) break;
    if (*rest != ',') return wrong;
    next = rest + 1;
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

Failure check_scene(const SceneOptions& options, const file::LoadedScene& loaded) {
  if (Failure failed = check_unchanging("accuracy", options, loaded)) return failed;
  if (loaded.scene.tick_count() > kMostAccuracyTicks) {
    return Error{ErrorKind::kUsage,
                 fmt::format("accuracy: it takes at most {} ticks, this scene has {}; --duration "
                             "shortens it",
                             kMostAccuracyTicks, loaded.scene.tick_count())};
  }
  return {};
}

Failure open_files(const OutputOptions& options, AccuracyFiles& files) {
  if (Failure failed = files.csv.open(options.csv)) return failed;
  if (Failure failed = files.json.open(options.json)) return failed;
  return files.plot.open(options.plot);
}

AccuracyStudy measure(const Scene& scene, std::vector<int> substeps, bool quiet) {
  Progress progress(scene.name, !quiet);
  AccuracyOptions options;
  options.substeps = std::move(substeps);
  options.now_ns = thread_processor_time_ns;
  options.should_stop = [] { return stop_signal() != 0; };
  options.on_progress = [&](double done) { progress.show(done); };
  return measure_accuracy(scene, options);
}

Failure write_figure(const Scene& scene, const AccuracyStudy& study, OutputFile& file) {
  if (!file.is_open()) return {};
  const Result<file::Picture> figure = ui::draw_work_precision(scene, study);
  if (!figure) return figure.error();
  const Result<std::string> bytes = file::encode_png(*figure);
  if (!bytes) return bytes.error();
  return file.write_whole(*bytes);
}

Failure write_results(const OutputOptions& options, AccuracyFiles& files, const Scene& scene,
                      const AccuracyStudy& study) {
  if (Failure failed = files.csv.write_whole(accuracy_csv(study))) return failed;
  if (Failure failed = files.json.write_whole(accuracy_json(study))) return failed;
  if (Failure failed = write_figure(scene, study, files.plot)) return failed;
  if (options.json == kStandardOutput) return write_output(accuracy_json(study));
  if (options.quiet) return {};
  return write_output(accuracy_table(study));
}

int accuracy(const CommandOptions& options) {
  if (!options.output.expectations.empty()) {
    return report({ErrorKind::kUsage,
                   "--expect: 'accuracy' has no single summary; 'hapticwall run SCENE --expect "
                   "EXPR' has, with --set simulator.integrator=NAME"});
  }
  if (const Failure failed = check_outputs(options.output, {options.scene.scene}))
    return report(*failed);
  Result<std::vector<int>> substeps = parse_substeps(options.substeps);
  if (!substeps) return report(substeps.error());
  if (const Failure failed = check_simulator("accuracy", options.scene.device))
    return report(*failed);
  const Result<file::LoadedScene> loaded = load_headless(options.scene);
  if (!loaded) return report(loaded.error());
  if (const Failure failed = check_scene(options.scene, *loaded)) return report(*failed);
  // From here on the files of a study that is ended early go with it.
  catch_stop_signals();
  AccuracyFiles files;
  if (const Failure failed = open_files(options.output, files)) return report(*failed);
  const AccuracyStudy study = measure(loaded->scene, *substeps, options.output.quiet);
  if (study.stopped_early) {
    tell(fmt::format("ended early by {}; nothing was written", signal_name(stop_signal())));
    return signal_exit_status(stop_signal());
  }
  const Failure failed = write_results(options.output, files, loaded->scene, study);
  return failed ? report(*failed) : 0;
}

}  // namespace

Command add_accuracy(CLI::App& program) {
  const auto options = std::make_shared<CommandOptions>();
  CLI::App* app = program.add_subcommand(
      "accuracy", "Speed against accuracy: every integrator and substep count on a scene");
  add_headless_options(*app, options->scene);
  add_algorithm_option(*app, options->scene);
  add_scene_options(*app, options->scene);
  add_simulator_option(*app, options->scene);
  app->add_option("--substeps", options->substeps,
                  fmt::format("Substeps a tick to measure, 1 to {}; default {}", kMaximumSubsteps,
                              kDefaultSubsteps))
      ->type_name("N,N,...");
  app->add_option("--csv", options->output.csv, "Write the table as CSV, a line a measurement")
      ->type_name("FILE");
  app->add_option("--plot", options->output.plot,
                  "Draw error over cost (work-precision diagram); needs no display")
      ->type_name("FILE.png");
  add_output_options(*app, options->output);
  app->get_option("--json")->description("Write the study as JSON; - is standard output");
  // Not offered, but known: whoever asks is told where to find it.
  app->get_option("--expect")->group("");
  return {app, [options] { return accuracy(*options); }};
}

}  // namespace hapticwall::command
