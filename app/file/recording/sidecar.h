// The text of a recording's sidecar: the whole scene and a [recording] table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/file/recording/recording_writer.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::file {

inline constexpr std::string_view kEditedSidecar = "its sidecar was changed since it was written";

// Counted by the writer of the CSV.
struct RecordedRows {
  std::uint64_t rows = 0;
  std::uint64_t dropped_rows = 0;
  std::uint64_t session_ticks = 0;
  std::string csv_sha256;
  bool finished = true;  // false: more rows may follow, and the CSV has no SHA-256 yet
};

// The sidecar's duration is that of the session; if no scene can be that long, the sidecar says
// that the session cannot be repeated. Takes the hands' paths from `scene` alone, not from the
// changes.
[[nodiscard]] std::string sidecar_toml(Scene scene, const RecordingMetadata& metadata,
                                       const RecordedRows& recorded);

// NAME.toml beside NAME.csv (or beside any other name); NAME.toml.partial beside NAME.csv.partial.
[[nodiscard]] std::string sidecar_path_of(const std::string& csv_path);

// The sidecar of a recording that is there: beside the file, where it is written, else beside the
// link that names the file.
[[nodiscard]] std::string find_sidecar(const std::string& csv_path);

// Gives NAME.csv its sidecar. A NAME.toml.partial holds the old or the new text at any moment, also
// on a full disk or after a kill.
[[nodiscard]] Failure write_sidecar(const std::string& csv_path, std::string_view text);

// Reason why no sidecar may be written at `path`: only an older one of the same kind is replaced.
// Empty if it may.
[[nodiscard]] std::string sidecar_obstacle(const std::string& path, std::string_view table);

}  // namespace hapticwall::file
