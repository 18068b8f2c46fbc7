// Runs the hand of a recording again, under another algorithm, wall or device.
//
// A simulator's recording holds the hand's intended position at every tick (hand_path_m), whether a
// script or the pointer led it. Between two ticks a pointer's intention moves evenly, so these
// positions describe it completely. A script may bend between two ticks, and its speed has more
// digits than their difference; it is in the sidecar. The hand therefore follows the script while
// the recorded positions equal it bit for bit; elsewhere it moves from one recorded position to the
// next.
//
// Under its own algorithm this repeats the recording bit for bit, also if the pointer led, on the
// same build and kind of machine. Exceptions:
//   - a recording that began during its session, if the pointer had led before its first row: the
//     plant's past is not recorded. The hand then moves evenly from the start to its first recorded
//     position. (A session that was reset begins anew.)
//   - hand_force_n of a hand with a damper and without a grip, at ticks at which the pointer jumps,
//     or the plant changes, before the hand has caught up with the pointer: it depends on the
//     hand's next speed, which is not recorded. No other number depends on it.
//   - a recording with two axes: only axis x is run again.
//   - a pointer that meets the script exactly and leaves it again within one tick.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/scene/scene_file.h"
#include "app/session/replay_session.h"
#include "core/result.h"
#include "core/summary.h"

namespace hapticwall::session {

struct RerunOptions {
  // Called with every tick of the recording, in order, from its first row on.
  std::function<void(const Sample&)> on_sample;
  // Called about every thousand ticks with the fraction done; false ends the re-run early.
  std::function<bool(double fraction)> keep_going;
};

struct RerunOutcome {
  // Summary of all ticks up to the last row. Energies are those at the last tick.
  Summary summary;
  bool stopped_early = false;
  // Up to the last row; fewer if it diverged or was stopped.
  std::uint64_t ticks = 0;
  bool pointer_led = false;  // led at any tick: then the sidecar alone does not repeat the run
  // Compared with the recording: the first tick at which a value other than hand_force_n differs,
  // and the largest distance between the true positions.
  std::optional<std::uint64_t> first_different_tick;
  double largest_distance_m = 0.0;
};

// Fails (exit status 2) if the recording is of a device, has no sidecar, or lacks
// rows.
[[nodiscard]] Failure check_rerun(const file::RecordingInfo& recording);

// The scene of the re-run: the recording's own scene and changes, with `overrides` (texts of
// --set), and under `algorithm` if that is not empty (its parameters stay those of the recording).
// Fails (exit status 2) where check_rerun() does, for overrides of the rate, the duration or the
// hand's path, and for overrides of a recording in which parameters change.
[[nodiscard]] Result<file::LoadedScene> rerun_scene(const file::RecordingInfo& recording,
                                                    const std::string& algorithm,
                                                    const std::vector<std::string>& overrides);

// Fails if the recording can no longer be read.
[[nodiscard]] Result<RerunOutcome> rerun_hand(file::RecordingReader& recording,
                                              const file::LoadedScene& scene,
                                              const RerunOptions& options = {});

// The sidecar's content for a recording of the re-run.
[[nodiscard]] file::RecordingMetadata rerun_metadata(const file::RecordingInfo& recording,
                                                     const file::LoadedScene& scene,
                                                     const RerunOutcome& outcome);

// The scene for studies, which run it any number of times: axis x of `wanted`, from rerun_scene(),
// for as long as the rows last. Its hand moves as rerun_hand() moves it, bit for bit. Precondition:
// `wanted` has no changes. Fails if the recording can no longer be read.
[[nodiscard]] Result<Scene> recorded_scene(file::RecordingReader& recording,
                                           const file::LoadedScene& wanted);

// An overlay is kept in memory.
inline constexpr std::uint64_t kMaxOverlaidTicks = 1'000'000;

// The re-run as an overlay for a replay; its label is the algorithm's name with the settings. Fails
// (exit status 2) where rerun_scene() and rerun_hand() do, for a recording with more rows, and when
// `keep_going` ends it. Realtime-safe: no.
[[nodiscard]] Result<Overlay> rerun_as_overlay(file::RecordingReader& recording,
                                               const std::string& algorithm,
                                               const std::vector<std::string>& settings,
                                               const std::function<bool(double)>& keep_going = {});

}  // namespace hapticwall::session
