// The text of a recording's sidecar: the whole scene and a [recording] table.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/file/recording_writer.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::file {

// What the writer of the CSV counted.
struct RecordedRows {
  std::uint64_t rows = 0;
  std::uint64_t dropped_rows = 0;
  std::uint64_t session_ticks = 0;
  std::string csv_sha256;
  bool finished = true;  // false: more rows may follow, and the CSV has no SHA-256 yet
};

// Where the session was not as long as scene.duration_s says, the sidecar says how long it was.
[[nodiscard]] std::string sidecar_toml(Scene scene, const RecordingMetadata& metadata,
                                       const RecordedRows& recorded);

// NAME.toml beside NAME.csv (or beside any other name); NAME.toml.partial beside NAME.csv.partial.
[[nodiscard]] std::string sidecar_path_of(const std::string& csv_path);

// Gives NAME.csv its sidecar. NAME.toml.partial, where there is one, is what it was or the new text
// at any moment: a full disk or a kill takes nothing of it.
[[nodiscard]] Failure write_sidecar(const std::string& csv_path, std::string_view text);

// Whether replacing the file at `path` destroys nothing but an older sidecar: there is none, or it
// has a table [recording] or [map].
[[nodiscard]] bool may_replace_sidecar(const std::string& path);

}  // namespace hapticwall::file
