// The sidecar of a recording, with its changes and marks: any text, and what is written out of it.
#include <optional>
#include <string>

#include "app/file/recording/sidecar.h"
#include "app/file/scene/scene_file.h"
#include "app/file/scene/seal.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

using file::LoadedScene;
using file::Mark;

// Sidecar as finishing or recovering the same recording would write it.
std::string written(const LoadedScene& loaded) {
  file::RecordingMetadata metadata;
  metadata.device = "simulator";
  metadata.realtime_status = "none";
  metadata.first_tick = loaded.first_recorded_tick;
  metadata.repeatable = loaded.not_repeatable_because.empty();
  metadata.not_repeatable_because = loaded.not_repeatable_because;
  for (const ScheduledChange& change : loaded.changes) {
    metadata.changes.push_back(change);
  }
  metadata.marks = loaded.marks;
  file::RecordedRows rows;
  rows.session_ticks = rows.rows = loaded.scene.tick_count();
  return file::sidecar_toml(loaded.scene, metadata, rows);
}

void require_marks(const LoadedScene& loaded) {
  require(loaded.marks.size() <= file::kMaxMarks, "there are not too many marks");
  std::uint64_t tick = 0;
  for (const Mark& mark : loaded.marks) {
    require(mark.tick >= tick, "marks are in the order of their ticks");
    require(mark.text.size() <= file::kMaxMarkBytes && is_clean(mark.text),
            "the text of a mark is a clean short line");
    tick = mark.tick;
  }
}

void require_same(const LoadedScene& a, const LoadedScene& b) {
  require(a.first_recorded_tick == b.first_recorded_tick && a.marks == b.marks,
          "first tick and marks read back the same");
  require(a.not_repeatable_because == b.not_repeatable_because, "so does why it is not repeatable");
  require(a.changes.size() == b.changes.size(), "so do as many changes");
  for (std::size_t i = 0; i < a.changes.size(); ++i) {
    require(a.changes[i].tick == b.changes[i].tick &&
                file::scene_to_toml(a.changes[i].scene) == file::scene_to_toml(b.changes[i].scene),
            "a change reads back the same");
  }
}

Outcome fuzz_one(Bytes input) {
  const std::string origin = "fuzz.toml";
  const Result<LoadedScene> loaded = file::parse_scene(text_of(input), origin);
  if (!loaded) {
    require_one_clean_line(loaded.error(), origin);
    return Outcome::kRefused;
  }
  require_marks(*loaded);
  const std::string text = written(*loaded);
  const Result<LoadedScene> again = file::parse_scene(text, "written.toml");
  require(again.ok(), "a sidecar that was written can be read");
  require_same(*loaded, *again);
  require(!again->edited, "a sidecar that was written has a whole seal");
  require(file::is_broken_seal("#\n" + text), "a line more breaks the seal");
  require(written(*again) == text, "a sidecar that was read is written the same");
  return Outcome::kTaken;
}

const Registered kRegistered({"sidecar", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
