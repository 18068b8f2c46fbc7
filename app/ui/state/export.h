// What is seen of a session as files: the samples as a recording, the plots as a picture.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>

#include "app/file/recording_writer.h"
#include "app/ui/sample_history.h"
#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::ui {

// What the files say of the session that they are taken from.
struct ExportSource {
  Scene scene;  // as it is now
  bool simulated = true;
  std::string device;  // for people
};

// Writes the samples of the range as a recording: CSV and sidecar, both only when they are whole.
// It is not repeatable: what was changed before and within the range is not known here. Returns the
// number of rows. Fails where there is no sample, and where the disk does.
[[nodiscard]] Result<std::uint64_t> export_csv(const SampleHistory& history, IndexRange range,
                                               const ExportSource& source,
                                               const std::string& csv_path);

// The name of a file, whatever a scene from elsewhere is called: what no file system takes, leads
// to another folder, or is read otherwise by a shell becomes '-', and no file is hidden.
[[nodiscard]] std::string plain_file_name(std::string name);

// "SCENE-ALGORITHM-FROM-TOs", in characters that every file system takes.
[[nodiscard]] std::string export_name(const Scene& scene, double from_s, double to_s);

// A path in `folder` that no file has yet: "-2", "-3" … are appended. `ending` with its dot.
[[nodiscard]] std::string unused_path(const std::string& folder, const std::string& name,
                                      const std::string& ending);

// A CSV that is written on a thread of its own while the session goes on: an hour takes a while.
class ExportJob {
 public:
  struct Outcome {
    std::string path;
    Result<std::uint64_t> rows;
  };

  // Takes a copy of the history, which is cheap. Precondition: !running().
  void start(const SampleHistory& history, IndexRange range, const ExportSource& source,
             const std::string& csv_path);
  [[nodiscard]] bool running() const { return future_.valid(); }
  // What became of it, once, when it is done; never waits.
  [[nodiscard]] std::optional<Outcome> take();

 private:
  std::shared_future<Outcome> future_;  // the last one to hold it waits for the end
};

}  // namespace hapticwall::ui
