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
  std::uint64_t missing_rows = 0;  // in holes
  std::uint64_t cut_bytes = 0;     // behind the last whole line
  std::vector<std::string> notes;  // what a person should know, a line each
};

// `path`: NAME.csv or NAME.csv.partial. Cuts NAME.csv.partial behind its last whole row and gives
// it and its sidecar their names. The sidecar says that it was recovered, and is not repeatable
// where a row tells of a change of parameters that NAME.toml.partial does not know. Changes nothing
// where it fails: no rows, no NAME.toml.partial, a NAME.csv that is there already
// (ErrorKind::kUsage); a recording that is still being written (ErrorKind::kFile). Realtime-safe:
// no.
[[nodiscard]] Result<Recovered> recover_recording(const std::string& path);

}  // namespace hapticwall::file
