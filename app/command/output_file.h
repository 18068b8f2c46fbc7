// A file that an option names, or none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/file/atomic_file.h"
#include "core/result.h"

namespace hapticwall::command {

class OutputFile {
 public:
  // Nothing is opened for an empty path (the option was not given) and for standard output.
  [[nodiscard]] Failure open(const std::string& path);
  [[nodiscard]] bool is_open() const { return file_.has_value(); }
  // Writes all of it and gives the file its name; nothing where none is open.
  [[nodiscard]] Failure write_whole(std::string_view text);

 private:
  std::optional<file::AtomicFile> file_;
};

}  // namespace hapticwall::command
