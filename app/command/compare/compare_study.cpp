#include "app/command/compare/compare_study.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/table/study_report.h"
#include "core/result.h"
#include "core/study/contact_study.h"

namespace hapticwall::command {
namespace {

Failure check_study_options(const SceneOptions& scene, const OutputOptions& output) {
  if (!output.expectations.empty()) {
    return usage_error(
        "--expect: not with --study, which has no summary; use 'hapticwall compare SCENE --expect "
        "EXPR'");
  }
  if (!output.plot.empty()) {
    return usage_error(
        "--plot: not with --study, which draws no figure; use 'hapticwall run SCENE --plot "
        "FILE.png'");
  }
  return check_outputs(output, {scene.scene, sidecar_read_with(scene.scene)});
}

Result<ContactStudyPlan> plan_study(const SceneOptions& scene,
                                    const std::vector<std::string>& names,
                                    const OutputOptions& output) {
  Result<std::vector<std::size_t>> algorithms = chosen_algorithms(names);
  if (!algorithms) return algorithms.error();
  Result<file::LoadedScene> loaded = load_for_study("compare", scene, output.quiet);
  if (!loaded) return loaded.error();
  if (Failure failed = check_scene_files(output, *loaded)) return *failed;
  ContactStudyPlan plan;
  plan.scene = std::move(loaded->scene);
  plan.algorithms = std::move(*algorithms);
  if (const std::optional<SceneProblem> problem = validate(plan)) {
    return usage_error(fmt::format("--study: {}: {}", problem->key, problem->message));
  }
  return plan;
}

std::vector<ContactMetrics> study(const ContactStudyPlan& plan, bool quiet) {
  Progress progress(fmt::format("study of {}", plan.scene.name), !quiet);
  return study_contact(plan, {.should_stop = [] { return stop_signal() != 0; },
                              .progress = [&](double done) { progress.show(done); }});
}

}  // namespace

Result<int> compare_study(const SceneOptions& scene, const OutputOptions& output,
                          const std::vector<std::string>& algorithms) {
  if (Failure failed = check_study_options(scene, output)) return *failed;
  const Result<ContactStudyPlan> plan = plan_study(scene, algorithms, output);
  if (!plan) return plan.error();
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(output);
  if (!files) return files.error();
  const std::vector<ContactMetrics> rows = study(*plan, output.quiet);
  if (rows.empty()) return ended_early();
  return status_of(files->write({table::study_csv(*plan, rows), table::study_json(*plan, rows),
                                 table::sheet_text(table::study_sheet(*plan, rows))}));
}

}  // namespace hapticwall::command
