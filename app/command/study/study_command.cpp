// Runs a study from the command line.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "app/command/commands.h"
#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/draw/figure/log_figure.h"
#include "app/file/text/text.h"
#include "app/session/loop/realtime_setup.h"

namespace hapticwall::command {
namespace {

Failure check_choices(const study::Study& study, const study::Choices& choices) {
  for (const study::Option& option : study.options) {
    const std::string text = study.chosen(choices, option.key);
    if (const std::string wrong = option.wrong(text); !wrong.empty()) {
      return usage_error(fmt::format("--{} {}: {}", option.key, file::in_quotes(text), wrong));
    }
  }
  return {};
}

std::optional<study::Outcome> compute(const study::Run& run, const std::string& label, bool quiet) {
  Progress progress(label, !quiet);
  return run({.should_stop = [] { return stop_signal() != 0; },
              .progress = [&](double done) { progress.show(done); },
              .now_ns = session::thread_processor_time_ns});
}

}  // namespace

Result<int> run_study(const study::Study& study, std::string_view command, std::string_view prefix,
                      const SceneOptions& scene, const OutputOptions& output,
                      const study::Choices& choices) {
  if (!output.expectations.empty())
    return usage_error(fmt::format("--expect: {}", study.instead_of_expect));
  if (Failure failed = check_outputs(output, {scene.scene, sidecar_read_with(scene.scene)}))
    return *failed;
  if (Failure failed = check_choices(study, choices)) return *failed;
  const Result<file::LoadedScene> loaded =
      load_for_study(std::string(command), scene, output.quiet);
  if (!loaded) return loaded.error();
  if (Failure failed = check_scene_files(output, *loaded)) return *failed;
  const Result<study::Run> run = study.plan(loaded->scene, choices);
  if (!run) return usage_error(fmt::format("{}: {}", prefix, run.error().message));
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(output);
  if (!files) return files.error();
  const auto outcome =
      compute(*run, fmt::format("{} of {}", study.name, loaded->scene.name), output.quiet);
  if (!outcome) return ended_early();
  return status_of(files->write(
      {outcome->csv, outcome->json, table::sheet_text(outcome->sheet), outcome->scene},
      [&](const draw::Paper& paper) { return draw::draw_log_page(*outcome->figure, paper); }));
}

Command add_study(CLI::App& program, const study::Study& study) {
  struct Given {
    SceneOptions scene;
    OutputOptions output;
    study::Choices choices;
  };
  const auto given = std::make_shared<Given>();
  CLI::App* app = program.add_subcommand(std::string(study.name), std::string(study.help));
  add_headless_options(*app, given->scene);
  if (!study.of_all_algorithms) add_algorithm_option(*app, given->scene);
  add_scene_options(*app, given->scene);
  add_simulator_option(*app, given->scene);
  for (const study::Option& option : study.options) {
    std::string& text = given->choices[std::string(option.key)] = option.default_value;
    app->add_option(fmt::format("--{}", option.key), text, option.help)
        ->type_name(std::string(option.type));
  }
  add_csv_option(*app, given->output,
                 fmt::format("Write the table as CSV, one line per {}", study.line));
  if (!study.figure.empty()) add_plot_option(*app, given->output, std::string(study.figure));
  if (!study.scene_file.empty()) {
    app->add_option("--scene-file", given->output.scene_file, std::string(study.scene_file))
        ->type_name("FILE.toml");
  }
  add_output_options(*app, given->output);
  app->get_option("--json")->description("Write the study as JSON; - is standard output");
  // Hidden: the error message says which command has it.
  app->get_option("--expect")->group("");
  return {app, [given, &study] {
            return run_study(study, study.name, study.name, given->scene, given->output,
                             given->choices);
          }};
}

}  // namespace hapticwall::command
