// The output files of a command.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/draw/figure/paper.h"
#include "app/file/disk/atomic_file.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::command {

// The path that means standard output.
inline constexpr std::string_view kStandardOutput = "-";

// --stream and --stream-every.
struct StreamChoice {
  std::string path;
  std::string every;
};

// The outputs of a command.
struct OutputOptions {
  std::string csv;
  std::string json;
  std::string plot;
  std::string width;  // of --plot: millimetres, "single" or "double"; "": the default
  std::string wav;
  std::string frames;  // the folder of a film
  StreamChoice stream;
  std::string device_file;  // the device file that identify writes
  std::string scene_file;   // the scene that a study writes
  std::vector<std::string> expectations;
  bool signals = false;  // adds the algorithms' signals to --csv, --stream and --plot
  bool quiet = false;
};

// Max ticks of a figure, because its samples are kept in memory.
inline constexpr std::uint64_t kMaxPlottedTicks = 1'000'000;

// True if the path is "-", /dev/stdout or another name of this descriptor.
[[nodiscard]] Result<bool> is_standard_output(const std::string& path);

// A file or a stream (a pipe, a device, /dev/stderr) that an option names, or none.
class OutputFile {
 public:
  // Opens nothing for an empty path and for standard output.
  [[nodiscard]] Failure open(const std::string& path);
  [[nodiscard]] bool is_open() const { return file_ || stream_; }
  // Writes `text` and gives a file its name; does nothing without an open file.
  [[nodiscard]] Failure write_whole(std::string_view text);
  void discard();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  std::optional<file::AtomicFile> file_;
  std::unique_ptr<std::FILE, Close> stream_;
  std::string stream_path_;
};

struct ResultTexts {
  std::string csv;
  std::string json;
  std::string table;  // the text for people
  std::string scene = {};
};

using DrawResult = std::function<Result<file::Picture>(const draw::Paper& paper)>;

// The width of --width in millimetres.
[[nodiscard]] Result<double> figure_width_mm(const std::string& width);

// The files of --csv, --json, --plot and --scene-file. They get their names when the command has
// succeeded.
class OutputFiles {
 public:
  // Opens them before anything runs.
  [[nodiscard]] static Result<OutputFiles> open(const OutputOptions& options);
  // Something else uses it: no table. Fails for --json on it.
  [[nodiscard]] Failure leave_standard_output();
  [[nodiscard]] bool wants_plot() const { return plot_.is_open(); }
  // Writes the open files, then the table (or the JSON for `--json -`) to standard output. A
  // failure does not stop the other writes; returns the first one. Calls `draw` only for --plot, on
  // a thread of its own, so that a stop signal ends the program at once.
  [[nodiscard]] Failure write(const ResultTexts& texts, const DrawResult& draw = {});

 private:
  [[nodiscard]] Failure write_figure(const DrawResult& draw);

  OutputFile csv_;
  OutputFile json_;
  OutputFile plot_;
  OutputFile scene_;
  std::string plot_path_;  // its ending chooses the format
  double plot_width_mm_ = draw::kDoubleWidthMm;
  bool prints_json_ = false;
  bool quiet_ = false;
};

}  // namespace hapticwall::command
