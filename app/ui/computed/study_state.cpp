#include "app/ui/computed/study_state.h"

#include <atomic>
#include <utility>

namespace hapticwall::ui {
namespace {

using Task = Computed<Scene, study::Outcome>;

// All stages, one after the other.
Result<bool> compute(const study::Study& study, const Scene& scene, const Task::Progress& progress,
                     const Task::Deliver& deliver) {
  for (const study::Choices& choices : study.stages) {
    const Result<study::Run> run = study.plan(scene, choices);
    if (!run) return run.error();
    std::atomic<double> done = 0.0;
    auto outcome = (*run)({.threads = background_thread_count(),
                           .should_stop = [&] { return !progress(done); },
                           .progress = [&](double fraction) { done = fraction; },
                           .now_ns = session::thread_processor_time_ns});
    if (!outcome) return false;
    deliver(std::move(*outcome));
  }
  return true;
}

}  // namespace

SceneStudy::SceneStudy(const study::Study& study)
    : study_(&study),
      task_([&study](
                const Scene& scene, const Task::Progress& progress,
                const Task::Deliver& deliver) { return compute(study, scene, progress, deliver); },
            [&study](Scene a, const Scene& b) {
              if (study.of_all_algorithms) a.algorithm.index = b.algorithm.index;
              return a == b;
            }) {}

void SceneStudy::start(const Scene& scene, double now_s) {
  stage_ = 0;
  started_s_ = now_s;
  task_.start(scene);
}

void SceneStudy::take(const Scene& present, double now_s) {
  if (!task_.is_asked(present)) {
    task_.stop();
    task_.clear_problem();
  }
  for (study::Outcome& outcome : task_.take()) {
    result_ = std::move(outcome);
    studied_ = task_.asked();
    spent_s_ = elapsed_s(now_s);
    started_s_ = now_s;
    complete_ = ++stage_ == study_->stages.size();
  }
  up_to_date_ = studied_ && task_.same(*studied_, present);
}

}  // namespace hapticwall::ui
