#include "app/command/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <future>
#include <system_error>
#include <thread>
#include <utility>

#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/draw/figure/figure_file.h"
#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

// Appends: a stream that is a file after all may have content.
std::FILE* open_stream(const file::OutputPlace& place) {
  if (!place.descriptor) return std::fopen(place.path.c_str(), "ae");
  const int descriptor = fcntl(*place.descriptor, F_DUPFD_CLOEXEC, 0);
  return descriptor < 0 ? nullptr : fdopen(descriptor, "w");
}

// Draws and encodes; the thread may outlive the wait.
Result<std::string> encoded(const DrawResult& draw, const std::string& path, double width_mm) {
  const Result<file::Picture> figure = draw({width_mm, draw::ink_of(path)});
  if (!figure) return figure.error();
  return draw::encode_figure(*figure, path);
}

}  // namespace

Result<double> figure_width_mm(const std::string& width) {
  if (width.empty() || width == "double") return draw::kDoubleWidthMm;
  if (width == "single") return draw::kSingleWidthMm;
  const std::optional<double> width_mm = file::parsed<double>(width);
  if (width_mm && *width_mm >= draw::kMinWidthMm && *width_mm <= draw::kMaxWidthMm)
    return *width_mm;
  return usage_error(fmt::format(
      "--width {}: it takes single ({:g} mm), double ({:g} mm) or {:g} to {:g}, in millimetres",
      file::in_quotes(width), draw::kSingleWidthMm, draw::kDoubleWidthMm, draw::kMinWidthMm,
      draw::kMaxWidthMm));
}

Result<bool> is_standard_output(const std::string& path) {
  if (path == kStandardOutput) return true;
  const Result<file::OutputPlace> place = file::output_place(path);
  if (!place) return place.error();
  return place->descriptor == STDOUT_FILENO;
}

Failure OutputFile::open(const std::string& path) {
  if (path.empty() || path == kStandardOutput) return {};
  const Result<file::OutputPlace> place = file::output_place(path);
  if (!place) return place.error();
  if (place->kind == file::PlaceKind::kStream) {
    stream_path_ = path;
    stream_.reset(open_stream(*place));
    if (stream_) return {};
    return file_error(fmt::format("{}: cannot be written: {}", file::shown(path),
                                  std::generic_category().message(errno)));
  }
  Result<file::AtomicFile> opened = file::AtomicFile::create(path);
  if (!opened) return opened.error();
  file_ = std::move(*opened);
  return {};
}

Failure OutputFile::write_whole(std::string_view text) {
  if (stream_) return write_stream(fileno(stream_.get()), file::shown(stream_path_) + ":", text);
  if (!file_) return {};
  if (Failure failed = file_->write(text)) return failed;
  return file_->commit();
}

void OutputFile::discard() { file_.reset(); }

Result<OutputFiles> OutputFiles::open(const OutputOptions& options) {
  OutputFiles files;
  const Result<bool> prints_json = is_standard_output(options.json);
  if (!prints_json) return prints_json.error();
  files.prints_json_ = *prints_json;
  files.quiet_ = options.quiet;
  if (Failure failed = files.csv_.open(options.csv)) return *failed;
  if (Failure failed = files.json_.open(*prints_json ? "" : options.json)) return *failed;
  if (Failure failed = files.plot_.open(options.plot)) return *failed;
  if (Failure failed = files.scene_.open(options.scene_file)) return *failed;
  files.plot_path_ = options.plot;
  const Result<double> width_mm = figure_width_mm(options.width);
  if (!width_mm) return width_mm.error();
  files.plot_width_mm_ = *width_mm;
  return files;
}

Failure OutputFiles::leave_standard_output() {
  quiet_ = true;
  if (!prints_json_) return {};
  return usage_error("--json and --stream: both are standard output; give one a file");
}

Failure OutputFiles::write_figure(const DrawResult& draw) {
  constexpr std::chrono::milliseconds kPollInterval{10};
  std::packaged_task<Result<std::string>()> task(
      [&] { return encoded(draw, plot_path_, plot_width_mm_); });
  std::future<Result<std::string>> drawn = task.get_future();
  std::thread painter(std::move(task));
  while (drawn.wait_for(kPollInterval) != std::future_status::ready) {
    if (stop_signal() == 0) continue;
    plot_.discard();
    std::_Exit(ended_early("; the figure was not drawn"));  // a figure cannot be interrupted
  }
  painter.join();
  const Result<std::string> bytes = drawn.get();
  return bytes ? plot_.write_whole(*bytes) : bytes.error();
}

Failure OutputFiles::write(const ResultTexts& texts, const DrawResult& draw) {
  Failure first = csv_.write_whole(texts.csv);
  const auto keep = [&](Failure failed) {
    if (!first) first = std::move(failed);
  };
  keep(json_.write_whole(texts.json));
  if (texts.scene.empty()) {
    scene_.discard();
  } else {
    keep(scene_.write_whole(texts.scene));
  }
  if (plot_.is_open()) keep(write_figure(draw));
  if (prints_json_) {
    keep(write_output(texts.json));
  } else if (!quiet_) {
    keep(write_output(texts.table));
  }
  return first;
}

}  // namespace hapticwall::command
