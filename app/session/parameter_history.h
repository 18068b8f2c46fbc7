// History of the scenes in force: the owner's side of the parameter exchange.
//
// The owner numbers every published scene. The loop echoes number and tick when it starts to use
// one. A scene that was replaced before the loop saw it was never in force.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "app/file/recording/recording_writer.h"
#include "app/session/loop/exchange.h"
#include "core/scene.h"

namespace hapticwall::session {

// Used by one thread. Realtime-safe: no.
class ParameterHistory {
 public:
  explicit ParameterHistory(const Scene& first);

  // The newest scene, in force or not, and its number.
  [[nodiscard]] const Scene& newest() const { return newest_; }
  [[nodiscard]] std::uint32_t generation() const { return generation_; }

  // Call it before publishing a newer scene. Only values that may change in a session
  // (scene_change.h) differ. `unread`: the loop never sees the previous one.
  void add(const Scene& scene, bool unread = false);

  // An echo of the loop. Echoes arrive in order.
  void came_into_force(const ParameterEcho& echo);

  // Scene at tick 0 of the present run.
  [[nodiscard]] Scene scene_at_start() const { return scene_with(newest_, at_start_); }
  // True if the loop has echoed the start of this run; until then the history belongs to the
  // previous run.
  [[nodiscard]] bool knows_start() const { return knows_start_; }
  // Index of the algorithm of the newest echo.
  [[nodiscard]] std::size_t algorithm_in_force() const {
    return published_.front().adjustment.algorithm.index;
  }
  // Increases with every echo.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  // Changes since tick 0 that were in force before `end_tick`, in order; scenes without hand paths.
  [[nodiscard]] std::vector<ScheduledChange> changes_before(std::uint64_t end_tick) const;
  // More changes than a sidecar holds (file::kMaxChanges); the rest is lost.
  [[nodiscard]] bool has_lost_changes() const { return lost_changes_; }

  // Call it before the loop goes back to tick 0.
  void restart() { knows_start_ = false; }

 private:
  // Values that may change in a session; the rest of the scene (a long path) is stored once.
  struct Adjustment {
    explicit Adjustment(const Scene& scene);

    std::vector<AxisSettings> axes;  // without the paths of their hands
    EnvironmentSettings environment;
    AlgorithmSettings algorithm;
    EstimatorSettings estimator;
    SimulatorSettings simulator;
  };
  struct Published {
    std::uint32_t generation;
    Adjustment adjustment;
  };
  struct Change {
    std::uint64_t tick;
    Adjustment adjustment;
  };

  [[nodiscard]] static Scene scene_with(Scene scene, const Adjustment& adjustment);

  Scene newest_;
  std::uint32_t generation_ = 1;
  std::deque<Published> published_;  // the scene in force, then those not yet echoed
  Adjustment at_start_;
  std::vector<Change> changes_;
  std::uint64_t revision_ = 0;
  bool knows_start_ = false;
  bool lost_changes_ = false;
};

}  // namespace hapticwall::session
