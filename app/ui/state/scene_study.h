// Studies of the present scene, computed beside the window when the user asks for them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "app/table/text_table.h"
#include "app/ui/state/background.h"
#include "core/scene.h"
#include "core/study/accuracy.h"

namespace hapticwall::ui {

struct StudyResult {
  table::Sheet sheet;
  std::string csv;                        // as the command line writes it
  std::optional<AccuracyStudy> accuracy;  // for its diagram
};

// How one kind of study is computed.
struct StudyKind {
  using Progress = Background<StudyResult>::Progress;
  using Stage = Result<StudyResult> (*)(const Scene& scene, const Progress& progress);

  // One after the other; each is finer than the one before and replaces its result.
  std::span<const Stage> stages;
  bool of_all_algorithms = false;  // the one in force does not matter
};

// 'hapticwall compare SCENE --study'.
[[nodiscard]] StudyKind ranking_study();
// 'hapticwall accuracy SCENE', first with few substep counts.
[[nodiscard]] StudyKind accuracy_study();

// All members are called from the owner's thread. None waits, except the destructor, which waits
// for the threads: at most a thousand ticks of a scene on each. Times are seconds of the owner's
// clock.
class SceneStudy {
 public:
  explicit SceneStudy(StudyKind kind) : kind_(kind) {}

  // Begins with the first stage; gives up what runs.
  void start(const Scene& scene, double now_s);
  // Gives the computation up; the result stays.
  void stop() { task_.give_up(); }
  // Takes a result that has come. Gives a computation up that is not of the present scene.
  void take(const Scene& present, double now_s);

  [[nodiscard]] bool running() const { return task_.running(); }
  // Of the present stage.
  [[nodiscard]] double fraction() const { return task_.fraction(); }
  // Whether the running stage is followed by a finer one.
  [[nodiscard]] bool coarse() const { return stage_ + 1 < kind_.stages.size(); }
  [[nodiscard]] double elapsed_s(double now_s) const { return now_s - started_s_; }
  // nullptr: none yet.
  [[nodiscard]] const StudyResult* result() const { return result_ ? &*result_ : nullptr; }
  // Whether the result is of the last stage, and how long that took.
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] double spent_s() const { return spent_s_; }
  // Whether the result is of the present scene.
  [[nodiscard]] bool up_to_date() const { return up_to_date_; }
  // Why the scene has no such study; "" if it has.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  [[nodiscard]] bool same(Scene a, const Scene& b) const;
  void begin_stage(double now_s);

  StudyKind kind_;
  Background<StudyResult> task_;
  Scene asked_;
  std::optional<Scene> studied_;  // the result's
  std::optional<StudyResult> result_;
  std::size_t stage_ = 0;  // running, or the next
  double started_s_ = 0.0;
  double spent_s_ = 0.0;
  bool complete_ = false;
  bool up_to_date_ = false;
  std::string problem_;
};

struct Studies {
  SceneStudy ranking{ranking_study()};
  SceneStudy accuracy{accuracy_study()};
  bool shows_accuracy = false;

  [[nodiscard]] SceneStudy& shown() { return shows_accuracy ? accuracy : ranking; }
  [[nodiscard]] bool running() const { return ranking.running() || accuracy.running(); }
  void stop() {
    ranking.stop();
    accuracy.stop();
  }
};

}  // namespace hapticwall::ui
