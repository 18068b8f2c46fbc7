// Exports of a session: the samples as a recording, the plots as a picture.
#pragma once

#include <cstdint>
#include <future>
#include <initializer_list>
#include <optional>
#include <string>

#include "app/draw/plot/sample_history.h"
#include "app/file/recording/recording_writer.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

// Description of the exported session.
struct ExportSource {
  Scene scene;  // scene at the time of the export
  bool simulated = true;
  std::string device;  // name for people
};

// Writes the samples of the range as a recording: CSV and sidecar, both only when they are
// complete. The recording is not repeatable, because earlier changes are not known here. Returns
// the number of rows. Fails when there is no sample and when the disk fails.
[[nodiscard]] Result<std::uint64_t> export_csv(const draw::SampleHistory& history,
                                               draw::IndexRange range, const ExportSource& source,
                                               const std::string& csv_path);

// A safe file name: replaces everything except letters, digits, "-", "_" and "." by "-", and never
// starts with a dot or a dash.
[[nodiscard]] std::string plain_file_name(std::string name);

// "SCENE-ALGORITHM-FROM-TOs" as a safe file name.
[[nodiscard]] std::string export_name(const Scene& scene, double from_s, double to_s);

// A path without its ending: NAME in `folder`, with "-2", "-3" … where a file with one of these
// endings exists. Endings include the dot.
[[nodiscard]] std::string unused_base(const std::string& folder, const std::string& name,
                                      std::initializer_list<std::string> endings);
// unused_base() for one ending, with that ending.
[[nodiscard]] std::string unused_path(const std::string& folder, const std::string& name,
                                      const std::string& ending);

// Writes a CSV on its own thread, because an hour of samples takes long.
class ExportJob {
 public:
  struct Outcome {
    std::string path;
    Result<std::uint64_t> rows;
  };

  // Copies the history, which is cheap. Precondition: !running().
  void start(const draw::SampleHistory& history, draw::IndexRange range, const ExportSource& source,
             const std::string& csv_path);
  [[nodiscard]] bool running() const { return future_.valid(); }
  // The result, once, when the job is done; never waits.
  [[nodiscard]] std::optional<Outcome> take();

 private:
  std::shared_future<Outcome> future_;  // the last owner waits for the end
};

}  // namespace hapticwall::ui
