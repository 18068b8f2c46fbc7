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
// where the rows tell of something that NAME.toml.partial does not know: a change of parameters, or
// a hand that has left its path. Changes nothing
// where it fails: no rows, no NAME.toml.partial, a NAME.csv that is there already
// (ErrorKind::kUsage); a recording that is still being written (ErrorKind::kFile). One that lacks
// only its name gets that. Realtime-safe: no.
[[nodiscard]] Result<Recovered> recover_recording(const std::string& path);

// Whether it was cut off between its two names: NAME.toml is the sidecar of what stands in
// NAME.csv.partial, by its SHA-256. Reads all rows. Realtime-safe: no.
[[nodiscard]] bool lacks_only_its_name(const std::string& csv_path);

}  // namespace hapticwall::file
