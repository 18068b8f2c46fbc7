#include "app/command/output_file.h"

#include <utility>

#include "app/command/common_options.h"

namespace hapticwall::command {

Failure OutputFile::open(const std::string& path) {
  if (path.empty() || path == kStandardOutput) return {};
  Result<file::AtomicFile> opened = file::AtomicFile::create(path);
  if (!opened) return opened.error();
  file_ = std::move(*opened);
  return {};
}

Failure OutputFile::write_whole(std::string_view text) {
  if (!file_) return {};
  if (Failure failed = file_->write(text)) return failed;
  return file_->commit();
}

}  // namespace hapticwall::command
