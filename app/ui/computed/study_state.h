// Studies of the present scene, computed beside the window when the user asks for them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/study/studies.h"
#include "app/ui/computed/computed.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Study of a scene beside the session, as Computed. Times are seconds of the owner's clock.
class SceneStudy {
 public:
  explicit SceneStudy(const study::Study& study);

  // Starts the first stage; cancels the running one.
  void start(const Scene& scene, double now_s);
  // Gives the computation up; the result stays.
  void stop() { task_.stop(); }
  // Takes a result that has come. Gives a computation up that is not of the present scene.
  void take(const Scene& present, double now_s);

  [[nodiscard]] const study::Study& study() const { return *study_; }
  [[nodiscard]] bool running() const { return task_.running(); }
  // Finished fraction of the present stage.
  [[nodiscard]] double fraction() const { return task_.fraction(); }
  // True if the running stage is followed by a finer one.
  [[nodiscard]] bool coarse() const { return stage_ + 1 < study_->stages.size(); }
  [[nodiscard]] double elapsed_s(double now_s) const { return now_s - started_s_; }
  // nullptr: none yet.
  [[nodiscard]] const study::Outcome* result() const { return result_ ? &*result_ : nullptr; }
  // complete(): the result is of the last stage. spent_s(): the time that it took.
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] double spent_s() const { return spent_s_; }
  // True if the result is of the present scene.
  [[nodiscard]] bool up_to_date() const { return up_to_date_; }
  // Why the scene has no such study; "" if it has.
  [[nodiscard]] const std::string& problem() const { return task_.problem(); }

 private:
  const study::Study* study_;
  Computed<Scene, study::Outcome> task_;
  std::optional<Scene> studied_;  // the result's
  std::optional<study::Outcome> result_;
  std::size_t stage_ = 0;  // running, or the next
  double started_s_ = 0.0;
  double spent_s_ = 0.0;
  bool complete_ = false;
  bool up_to_date_ = false;
};

struct Studies {
  std::vector<SceneStudy> all;
  std::size_t choice = 0;

  Studies() {
    for (const study::Study* study : study::studies()) all.emplace_back(*study);
  }
  [[nodiscard]] SceneStudy& shown() { return all[choice]; }
  [[nodiscard]] bool running() const {
    return std::ranges::any_of(all, [](const SceneStudy& study) { return study.running(); });
  }
  void stop() {
    for (SceneStudy& study : all) study.stop();
  }
};

}  // namespace hapticwall::ui
