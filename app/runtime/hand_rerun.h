// The hand of a recording once more, under another algorithm, wall or device.
//
// A simulator's recording holds where the hand intended to be at every tick (hand_path_m), whoever
// led it: a script or the pointer. Between two ticks a pointer's intention moves evenly, so that
// these positions are all there is to know of it. A script's may bend between two ticks, and its
// speed has more digits than their difference; it stands in the sidecar. So the hand follows the
// script where the recorded positions are those of the script, bit for bit, and is led from one
// recorded position to the next where they are not.
//
// Under its own algorithm that gives the recording again, bit for bit, also where the pointer led,
// with these exceptions, and on the same build and kind of machine:
//   - a recording that began while its session ran, if the pointer had led before its first row:
//     what the plant had been through is not recorded. The hand is then taken to have come to its
//     first recorded place evenly from the start. (A session that was reset begins anew.)
//   - hand_force_n of a hand without a grip but with a damper, at the ticks at which the pointer
//     jumps, or the plant changes, before the hand has caught up with the pointer: it is told for
//     the speed that the hand was about to have, which is not recorded. Nothing follows from it.
//   - of a recording with two axes axis x alone is run again.
//   - a pointer that within one tick comes upon the script, digit for digit, and leaves it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/file/recording_reader.h"
#include "app/file/scene_file.h"
#include "core/plant/hand_path.h"
#include "core/plant/plant_model.h"
#include "core/result.h"
#include "core/summary.h"

namespace hapticwall::runtime {

struct RerunOptions {
  // Every tick of the recording's, in order; those before its first row are simulated and not told.
  std::function<void(const Sample&)> on_sample;
  // Asked about every thousand ticks, with the fraction that is done; false ends the re-run early.
  std::function<bool(double fraction)> keep_going;
};

struct RerunOutcome {
  // Of all ticks up to the last row. Energies are those of the last tick's instant.
  Summary summary;
  bool stopped_early = false;
  // Up to the last row; fewer where it diverged or was stopped.
  std::uint64_t ticks = 0;
  bool pointer_led = false;  // at any tick: the sidecar alone does not repeat this
  // Beside the recording: where any number but hand_force_n is another for the first time, and how
  // far apart the true positions come to be.
  std::optional<std::uint64_t> first_different_tick;
  double largest_distance_m = 0.0;
};

// Why the hand of this recording cannot be re-run at all (exit status 2): it is of a device, has no
// sidecar, or has holes.
[[nodiscard]] Failure check_rerun(const file::RecordingInfo& recording);

// What the hand meets: the recording's own scene and changes, with `overrides` (texts of --set),
// and under `algorithm` throughout where that is not empty (its parameters stay those of the
// recording). Fails (exit status 2) for a recording of a device or without a sidecar or with holes;
// for overrides of what the recording decides (rate, duration, the hand's path); and for overrides
// of a recording in which parameters change.
[[nodiscard]] Result<file::LoadedScene> rerun_scene(const file::RecordingInfo& recording,
                                                    const std::string& algorithm,
                                                    const std::vector<std::string>& overrides);

// Fails where the recording can no longer be read.
[[nodiscard]] Result<RerunOutcome> rerun_hand(file::RecordingReader& recording,
                                              const file::LoadedScene& scene,
                                              const RerunOptions& options = {});

// Makes a plant's hand go through recorded positions.
class RecordedHand {
 public:
  // `positions_m`: at the ticks from `first_tick` on. Precondition: at least one.
  RecordedHand(const Scene& scene, std::uint64_t first_tick, std::vector<double> positions_m);

  // To be called at every tick from 0 on, once the plant is at it and before it goes on.
  void lead(PlantModel& plant);
  [[nodiscard]] bool has_led() const { return has_led_; }

 private:
  [[nodiscard]] std::optional<double> position_m(std::uint64_t tick) const;
  [[nodiscard]] double reached_m(double from_m, double target_m) const;
  [[nodiscard]] double target_m(double from_m, double to_m) const;

  HandPath script_;  // one tick ahead of the plant
  double reach_m_;   // of a pointer, in a tick
  std::uint64_t first_tick_;
  std::vector<double> positions_m_;
  std::optional<double> start_m_;  // where the way to the first position is not the script's
  std::uint64_t tick_ = 0;
  bool leads_ = false;
  bool has_led_ = false;
};

}  // namespace hapticwall::runtime
