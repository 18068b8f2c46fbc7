// One scene under all algorithms, computed beside the window.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/sample_history.h"
#include "app/ui/state/background.h"
#include "core/algorithm/algorithm.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::ui {

// Of a run that is drawn: its last seconds, in so many pairs of a smallest and a largest value.
inline constexpr double kTraceS = 2.0;
inline constexpr std::size_t kTraceColumns = 400;

// A run under one algorithm, or under one form of it.
struct AlgorithmRun {
  ComparedAlgorithm algorithm;
  Summary summary;
  draw::Trace position_m;  // true; empty if the run diverged before its last seconds
};

// Runs the scene under each of algorithms(), from rest, by simulate(). Empty if `goes_on` returned
// false. Throws as simulate() does.
[[nodiscard]] std::vector<AlgorithmRun> run_all(
    const Scene& scene, const std::function<bool(double fraction)>& goes_on = {});

// All members are called from the owner's thread. None waits, except the destructor.
class AllRuns {
 public:
  // Computes the runs of this scene, unless they are the newest ones. Its algorithm alone does not
  // count, but all parameters do.
  void ask_for(const Scene& scene);
  // Gives the computation up; the runs of the scene before stay.
  void stop() { task_.give_up(); }
  void take();

  [[nodiscard]] bool running() const { return task_.running(); }
  [[nodiscard]] double fraction() const { return task_.fraction(); }
  [[nodiscard]] std::span<const AlgorithmRun> runs() const { return runs_; }
  // Whether the runs are of the scene that was asked for.
  [[nodiscard]] bool up_to_date() const { return up_to_date_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  Background<std::vector<AlgorithmRun>> task_;
  std::optional<Scene> asked_;
  std::vector<AlgorithmRun> runs_;
  bool up_to_date_ = false;
  std::string problem_;
};

}  // namespace hapticwall::ui
