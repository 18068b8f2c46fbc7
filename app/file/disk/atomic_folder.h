// A folder of files that gets its name only when it is complete.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace hapticwall::file {

// Writes into PATH.partial. commit() syncs the files and renames the folder. Errors are
// ErrorKind::kFile and name the folder. Realtime-safe: no.
class AtomicFolder {
 public:
  // Refuses a PATH that exists and is no empty folder, and a PATH.partial that exists.
  [[nodiscard]] static Result<AtomicFolder> create(const std::string& path);

  AtomicFolder(AtomicFolder&& other) noexcept;
  AtomicFolder& operator=(AtomicFolder&& other) noexcept;
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;
  // Removes the partial folder and the files that were written, if it was not committed.
  ~AtomicFolder();

  // Writes a new file into the folder. `name`: without a slash.
  [[nodiscard]] Failure write(const std::string& name, std::string_view bytes);
  [[nodiscard]] Failure commit();

 private:
  AtomicFolder(std::string path, std::string partial_path, int descriptor);
  void discard();
  [[nodiscard]] Error failure(std::string_view what) const;  // reads errno

  std::string path_;
  std::string partial_path_;
  int descriptor_ = -1;
  std::vector<std::string> names_;
};

}  // namespace hapticwall::file
