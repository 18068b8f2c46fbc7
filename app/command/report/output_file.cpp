#include "app/command/report/output_file.h"

#include <utility>

#include "app/command/report/terminal.h"

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

Result<OutputFiles> OutputFiles::open(const OutputOptions& options) {
  OutputFiles files;
  files.prints_json_ = options.json == kStandardOutput;
  files.quiet_ = options.quiet;
  if (Failure failed = files.csv_.open(options.csv)) return *failed;
  if (Failure failed = files.json_.open(options.json)) return *failed;
  if (Failure failed = files.plot_.open(options.plot)) return *failed;
  return files;
}

Failure OutputFiles::write(const ResultTexts& texts,
                           const std::function<Result<file::Picture>()>& draw) {
  if (Failure failed = csv_.write_whole(texts.csv)) return failed;
  if (Failure failed = json_.write_whole(texts.json)) return failed;
  if (plot_.is_open()) {
    const Result<file::Picture> figure = draw();
    if (!figure) return figure.error();
    const Result<std::string> bytes = file::encode_png(*figure);
    if (!bytes) return bytes.error();
    if (Failure failed = plot_.write_whole(*bytes)) return failed;
  }
  if (prints_json_) return write_output(texts.json);
  return quiet_ ? Failure() : write_output(texts.table);
}

}  // namespace hapticwall::command
