// Scenes, and the sidecars of recordings, which are scenes with more in them: any text.
#include <string>

#include "app/file/scene/scene_file.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

// Whatever is written reads back as the same.
void require_repeatable(const Scene& scene) {
  require(!validate(scene), "a scene that was taken is valid");
  const std::string written = file::scene_to_toml(scene);
  const Result<file::LoadedScene> again = file::parse_scene(written, "written.toml");
  require(again.ok(), "a scene that was written can be read");
  require(file::scene_to_toml(again->scene) == written, "a scene that was read is the same");
}

Outcome fuzz_one(Bytes input) {
  const std::string origin = "fuzz.toml";
  const Result<file::LoadedScene> loaded = file::parse_scene(text_of(input), origin);
  if (!loaded) {
    require_one_clean_line(loaded.error(), origin);
    return Outcome::kRefused;
  }
  require_repeatable(loaded->scene);
  require(is_clean(loaded->scene.name) && is_clean(loaded->scene.description),
          "the texts of a scene are clean lines");
  std::uint64_t tick = 0;
  for (const ScheduledChange& change : loaded->changes) {
    require(!validate(change.scene), "a change that was taken is valid");
    require(change.tick >= tick, "changes are in the order of their ticks");
    tick = change.tick;
  }
  return Outcome::kTaken;
}

const Registered kRegistered({"scene", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
