// The text of a recording's sidecar: the whole scene and a [recording] table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/file/recording_writer.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::file {

// More is no sidecar. A change of all walls, device and hand takes 4 KB at most.
inline constexpr std::size_t kLargestSidecarBytes = std::size_t{1} << 26U;
// Of one recording; a slider that is dragged makes sixty a second.
inline constexpr std::size_t kMostChanges = 10'000;

// What the writer of the CSV counted.
struct RecordedRows {
  std::uint64_t rows = 0;
  std::uint64_t dropped_rows = 0;
  std::uint64_t session_ticks = 0;
  std::string csv_sha256;
  bool finished = true;  // false: more rows may follow, and the CSV has no SHA-256 yet
};

// Where the session was not as long as scene.duration_s says, the sidecar says how long it was, and
// that it cannot be repeated where no scene can be that long. Of the hands' paths only those of
// `scene` are looked at.
[[nodiscard]] std::string sidecar_toml(Scene scene, const RecordingMetadata& metadata,
                                       const RecordedRows& recorded);

// NAME.toml beside NAME.csv (or beside any other name); NAME.toml.partial beside NAME.csv.partial.
[[nodiscard]] std::string sidecar_path_of(const std::string& csv_path);

// Gives NAME.csv its sidecar. NAME.toml.partial, where there is one, is what it was or the new text
// at any moment: a full disk or a kill takes nothing of it.
[[nodiscard]] Failure write_sidecar(const std::string& csv_path, std::string_view text);

// What a sidecar belongs to, by the table that makes it one.
inline constexpr std::string_view kRecordingTable = "recording";
inline constexpr std::string_view kMapTable = "map";

// Whether the file at `path` has this table, and is no larger than a sidecar.
[[nodiscard]] bool is_sidecar(const std::string& path, std::string_view table);

// Whether replacing the file at `path` destroys nothing but an older sidecar of the same kind.
[[nodiscard]] bool may_replace_sidecar(const std::string& path, std::string_view table);

}  // namespace hapticwall::file
