// Which scene came into force at which tick: the owner's side of the parameter exchange.
//
// The owner numbers every scene that it publishes; the loop echoes number and tick when it begins
// to use one. A scene that was overtaken by a newer one before the loop saw it was never in force.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "app/file/recording_writer.h"
#include "app/runtime/exchange.h"
#include "core/scene.h"

namespace hapticwall::runtime {

// Used by one thread. Realtime-safe: no.
class ParameterHistory {
 public:
  explicit ParameterHistory(const Scene& first);

  // The newest scene, whether in force yet or not, and its number.
  [[nodiscard]] const Scene& newest() const { return newest_; }
  [[nodiscard]] std::uint32_t generation() const { return generation_; }

  // A newer scene is about to be published; only what may change in a session (scene_change.h)
  // differs from the one before. `unread`: the loop has not seen the one before and never will.
  void add(const Scene& scene, bool unread = false);

  // The loop's word. Echoes come in the order in which they were sent.
  void came_into_force(const ParameterEcho& echo);

  // As it was at tick 0 of the run that goes on now.
  [[nodiscard]] Scene scene_at_start() const { return scene_with(newest_, at_start_); }
  // Whether the loop has said how that run began; what is known until then is of an earlier one.
  [[nodiscard]] bool knows_start() const { return knows_start_; }
  // Grows with every word of the loop.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  // Since tick 0, in order, those in force before `end_tick`; scenes without their hands' paths.
  [[nodiscard]] std::vector<file::RecordedChange> changes_before(std::uint64_t end_tick) const;
  // There were more than a sidecar has room for (file::kMostChanges): the rest is not kept.
  [[nodiscard]] bool has_lost_changes() const { return lost_changes_; }

  // The loop is about to go back to tick 0.
  void restart() { knows_start_ = false; }

 private:
  // What a live session lets its user change; the rest of the scene (a long path) is kept once.
  struct Adjustment {
    explicit Adjustment(const Scene& scene);

    DeviceSettings device;
    std::optional<HandSettings> hand;  // less its path
    std::vector<WallSettings> walls;
    std::optional<SecondAxis> y;  // less its hand's path
    AlgorithmSettings algorithm;
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
  std::deque<Published> published_;  // the one in force first, then those not yet echoed
  Adjustment at_start_;
  std::vector<Change> changes_;
  std::uint64_t revision_ = 0;
  bool knows_start_ = false;
  bool lost_changes_ = false;
};

}  // namespace hapticwall::runtime
