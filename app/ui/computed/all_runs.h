// One scene under all algorithms, computed beside the window.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/sample_history.h"
#include "app/ui/computed/computed.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::ui {

// Length of a drawn trace: the last seconds of the run, as this many pairs of minimum and maximum.
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

// Two scenes are the same question if they differ in nothing but the algorithm in force.
class AllRuns : public Computed<Scene, std::vector<AlgorithmRun>> {
 public:
  AllRuns();
  void take() {
    for (auto& runs : Computed::take()) runs_ = std::move(runs);
  }
  [[nodiscard]] std::span<const AlgorithmRun> runs() const { return runs_; }
  // True if the runs are of the scene that was asked for.
  [[nodiscard]] bool up_to_date() const { return answered(); }

 private:
  std::vector<AlgorithmRun> runs_;
};

}  // namespace hapticwall::ui
