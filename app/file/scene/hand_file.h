// Reads the path of a measured hand from a CSV file with the columns time_s and position_m. Others
// are skipped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::file {

inline constexpr std::size_t kMaxHandBytes = std::size_t{1} << 26U;
inline constexpr std::string_view kHandHeader = "time_s,position_m";

// The points in order of their times: seconds from 0 on, positions within ±1 m. Times that begin
// outside of 0 to 1e6 s are shifted, so that the first one is 0. Fails (exit status
// 2) at the first wrong line; `origin` names the text ("hand.csv:12: position_m: no …"). Skips a
// byte order mark.
[[nodiscard]] Result<std::vector<PathPoint>> parse_hand(std::string_view text,
                                                        const std::string& origin);

// The path with the absolute name of its file and its SHA-256. Fails where parse_hand() does, and
// for everything but a file of at most kMaxHandBytes, not of /proc or /sys. Realtime-safe: no.
[[nodiscard]] Result<SharedPath> read_hand_file(const std::string& path);

// The scene for a file in the folder of `written`: the names of its hands' files are relative to
// that folder. Realtime-safe: no.
[[nodiscard]] Scene beside(Scene scene, const std::string& written);

}  // namespace hapticwall::file
