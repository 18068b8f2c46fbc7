// The hand of a recording under another algorithm, as what is laid over its replay.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/file/recording_reader.h"
#include "app/runtime/replay_session.h"
#include "core/result.h"

namespace hapticwall::runtime {

// An overlay is kept in memory, all of it.
inline constexpr std::uint64_t kMostOverlaidTicks = 1'000'000;

// Its label is the algorithm's name, with the settings behind it. Of rerun_scene() and
// rerun_hand(). Fails (exit status 2) where they do, for a recording that has more rows, and where
// `keep_going` ended it: asked now and then with the fraction that is done. Realtime-safe: no.
[[nodiscard]] Result<Overlay> rerun_as_overlay(file::RecordingReader& recording,
                                               const std::string& algorithm,
                                               const std::vector<std::string>& settings,
                                               const std::function<bool(double)>& keep_going = {});

}  // namespace hapticwall::runtime
