#include "app/ui/state/scene_study.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "app/runtime/loop/realtime_setup.h"
#include "app/table/accuracy_report.h"
#include "app/table/study_report.h"
#include "core/algorithm/algorithm.h"
#include "core/study/contact_study.h"

namespace hapticwall::ui {
namespace {

constexpr std::array kFewSubsteps{1, 10, 100};

Result<StudyResult> rank_algorithms(const Scene& scene, const StudyKind::Progress& progress) {
  runtime::set_up_background_thread();
  ContactStudyPlan plan;
  plan.scene = scene;
  for (std::size_t i = 0; i < algorithms().size(); ++i) plan.algorithms.push_back(i);
  if (const auto problem = validate(plan)) {
    return Error{ErrorKind::kUsage, problem->key + ": " + problem->message};
  }
  std::atomic<double> done = 0.0;
  const std::vector<ContactMetrics> rows =
      study_contact(plan, {.threads = background_thread_count(),
                           .should_stop = [&] { return !progress(done); },
                           .progress = [&](double fraction) { done = fraction; }});
  return StudyResult{table::study_sheet(plan, rows), table::study_csv(plan, rows), {}};
}

Result<StudyResult> measure_integrators(const Scene& scene, std::span<const int> substeps,
                                        const StudyKind::Progress& progress) {
  runtime::set_up_background_thread();
  if (scene.tick_count() > kMaxAccuracyTicks) {
    return Error{ErrorKind::kUsage,
                 fmt::format("It takes at most {} ticks, and this scene has {}. A scene file or "
                             "--duration makes it shorter.",
                             kMaxAccuracyTicks, scene.tick_count())};
  }
  double done = 0.0;
  AccuracyOptions options;
  options.substeps.assign(substeps.begin(), substeps.end());
  options.now_ns = runtime::thread_processor_time_ns;
  options.should_stop = [&] { return !progress(done); };
  options.on_progress = [&](double fraction) { done = fraction; };
  AccuracyStudy study = measure_accuracy(scene, options);
  StudyResult result{table::accuracy_sheet(study), table::accuracy_csv(study), {}};
  result.accuracy = std::move(study);
  return result;
}

}  // namespace

StudyKind ranking_study() {
  static constexpr std::array<StudyKind::Stage, 1> kStages{rank_algorithms};
  return {kStages, true};
}

StudyKind accuracy_study() {
  using Progress = StudyKind::Progress;
  static constexpr std::array<StudyKind::Stage, 2> kStages{
      [](const Scene& scene, const Progress& progress) {
        return measure_integrators(scene, kFewSubsteps, progress);
      },
      [](const Scene& scene, const Progress& progress) {
        return measure_integrators(scene, kUsualSubsteps, progress);
      }};
  return {kStages, false};
}

bool SceneStudy::same(Scene a, const Scene& b) const {
  if (kind_.of_all_algorithms) a.algorithm.index = b.algorithm.index;
  return a == b;
}

void SceneStudy::start(const Scene& scene, double now_s) {
  asked_ = scene;
  stage_ = 0;
  problem_.clear();
  begin_stage(now_s);
}

void SceneStudy::begin_stage(double now_s) {
  started_s_ = now_s;
  task_.start([stage = kind_.stages[stage_], scene = asked_](const auto& progress) {
    return stage(scene, progress);
  });
}

void SceneStudy::take(const Scene& present, double now_s) {
  if (!same(asked_, present)) {
    stop();
    problem_.clear();
  }
  up_to_date_ = studied_ && same(*studied_, present);
  auto ended = task_.take();
  if (!ended) return;
  if (!ended->ok()) {
    problem_ = ended->error().message;
    return;
  }
  result_ = std::move(**ended);
  studied_ = asked_;
  up_to_date_ = true;
  spent_s_ = elapsed_s(now_s);
  complete_ = ++stage_ == kind_.stages.size();
  if (!complete_) begin_stage(now_s);
}

}  // namespace hapticwall::ui
