// Finishes a recording that was cut off: the program was killed, or the disk was full.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace hapticwall::file {

struct Recovered {
  std::string csv_path;
  std::uint64_t rows = 0;
  std::uint64_t missing_rows = 0;  // number of ticks without a row
  std::uint64_t cut_bytes = 0;     // bytes removed after the last whole line
  std::vector<std::string> notes;  // warnings for the user, one line each
};

// `path`: NAME.csv or NAME.csv.partial. Cuts NAME.csv.partial after its last whole row and gives it
// and its sidecar their names. The sidecar says that the recording was recovered. It says that the
// recording is not repeatable if the rows show a change of parameters, or a hand off its path, that
// NAME.toml.partial lacks. If only the name is missing, it gives the name. Fails without changing
// anything if there are no rows, no NAME.toml.partial, or a NAME.csv already (ErrorKind::kUsage),
// and if the recording is still being written (ErrorKind::kFile). Realtime-safe: no.
[[nodiscard]] Result<Recovered> recover_recording(const std::string& path);

// True if the recording was cut off between its two renames: by its SHA-256, NAME.toml is the
// sidecar of NAME.csv.partial. Reads all rows. Realtime-safe: no.
[[nodiscard]] bool lacks_only_its_name(const std::string& csv_path);

}  // namespace hapticwall::file
