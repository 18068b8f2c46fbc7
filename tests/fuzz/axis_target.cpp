// --x, --y and --boundary of a map: any text that an argument can hold.
#include <cmath>
#include <string>

#include "app/command/map/map_axis.h"
#include "app/file/scene/scene_file.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

// One wall, or more.
Scene scene_with(const char* more) {
  const std::string one_axis =
      "[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1\n"
      "[hand]\nstiffness_n_per_m = 100\ndamping_n_s_per_m = 1\npath = [[0, 0.06]]\n"
      "[[wall]]\nposition_m = 0.05\nstiffness_n_per_m = 1000\n";
  return file::parse_scene(one_axis + more, "axis.toml")->scene;
}

void require_values(const MapAxis& axis) {
  require(std::isfinite(axis.low) && std::isfinite(axis.high) && axis.low < axis.high,
          "an axis has a range");
  require(axis.count >= 2 && axis.count <= kMaxMapValues, "an axis has some values");
  require(!axis.logarithmic || axis.low > 0.0, "a logarithm is of what is more than 0");
  require(axis.value(0) == axis.low && axis.value(axis.count - 1) == axis.high,
          "the ends of an axis are among its values");
  for (std::size_t i = 0; axis.number.whole && i < axis.count; ++i) {
    require(axis.value(i) == std::round(axis.value(i)), "what counts is counted in whole numbers");
  }
}

Outcome on_scene(const std::string& text, const Scene& scene) {
  const Result<MapAxis> axis = command::parse_map_axis("--x", text, scene);
  if (!axis) {
    require_one_clean_line(axis.error(), "--x ");
    return Outcome::kRefused;
  }
  require(text.starts_with(axis->number.path) || text.starts_with("wall[0]."),
          "an axis is the number that was asked for");
  require_values(*axis);
  return Outcome::kTaken;
}

Outcome fuzz_one(Bytes input) {
  static const Scene kOne = scene_with("");
  static const Scene kTwo = scene_with("[[wall]]\nposition_m = 0.055\nstiffness_n_per_m = 2000\n");
  const std::string text(text_of(input).substr(0, text_of(input).find('\0')));
  const Outcome of_two = on_scene(text, kTwo);
  const Outcome of_one = on_scene(text, kOne);
  return of_one == Outcome::kTaken ? of_one : of_two;
}

const Registered kRegistered({"axis", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
