#include "app/command/compare_study.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "app/command/device_choice.h"
#include "app/command/output_file.h"
#include "app/command/progress.h"
#include "app/command/signals.h"
#include "app/command/terminal.h"

namespace hapticwall::command {
namespace {

Failure check_study_options(const SceneOptions& scene, const OutputOptions& output) {
  if (!output.expectations.empty()) {
    return Error{ErrorKind::kUsage,
                 "--expect: not with --study, which has no summary; 'hapticwall compare SCENE "
                 "--expect EXPR' has"};
  }
  if (!output.plot.empty()) {
    return Error{ErrorKind::kUsage,
                 "--plot: not with --study, which draws no figure; 'hapticwall run SCENE --plot "
                 "FILE.png' does"};
  }
  if (Failure failed = check_outputs(output, {scene.scene})) return failed;
  return check_simulator("compare", scene.device);
}

Result<ContactStudyPlan> plan_study(const SceneOptions& scene,
                                    const std::vector<std::string>& names) {
  Result<std::vector<std::size_t>> algorithms = chosen_algorithms(names);
  if (!algorithms) return algorithms.error();
  Result<file::LoadedScene> loaded = load_headless(scene);
  if (!loaded) return loaded.error();
  if (Failure failed = check_unchanging("compare", scene, *loaded)) return *failed;
  ContactStudyPlan plan;
  plan.scene = std::move(loaded->scene);
  plan.algorithms = std::move(*algorithms);
  if (const std::optional<SceneProblem> problem = validate(plan)) {
    return Error{ErrorKind::kUsage, fmt::format("--study: {}: {}", problem->key, problem->message)};
  }
  return plan;
}

std::vector<ContactFigures> study(const ContactStudyPlan& plan, bool quiet) {
  Progress progress(fmt::format("study of {}", plan.scene.name), !quiet);
  return study_contact(plan, {.should_stop = [] { return stop_signal() != 0; },
                              .progress = [&](double done) { progress.show(done); }});
}

Failure write_results(const ContactStudyPlan& plan, const std::vector<ContactFigures>& rows,
                      const OutputOptions& output, OutputFile& csv, OutputFile& json) {
  if (Failure failed = csv.write_whole(study_csv(plan, rows))) return failed;
  const std::string text = study_json(plan, rows);
  if (Failure failed = json.write_whole(text)) return failed;
  if (output.json == kStandardOutput) return write_output(text);
  if (output.quiet) return {};
  return write_output(study_table(plan, rows));
}

}  // namespace

int compare_study(const SceneOptions& scene, const OutputOptions& output,
                  const std::vector<std::string>& algorithms) {
  if (const Failure failed = check_study_options(scene, output)) return report(*failed);
  const Result<ContactStudyPlan> plan = plan_study(scene, algorithms);
  if (!plan) return report(plan.error());
  // From here on the files of a study that is ended early go with it.
  catch_stop_signals();
  OutputFile csv;
  OutputFile json;
  if (const Failure failed = csv.open(output.csv)) return report(*failed);
  if (const Failure failed = json.open(output.json)) return report(*failed);
  const std::vector<ContactFigures> rows = study(*plan, output.quiet);
  if (rows.empty()) {
    tell(fmt::format("ended early by {}; nothing was written", signal_name(stop_signal())));
    return signal_exit_status(stop_signal());
  }
  const Failure failed = write_results(*plan, rows, output, csv, json);
  return failed ? report(*failed) : 0;
}

}  // namespace hapticwall::command
