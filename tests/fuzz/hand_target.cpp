// The path of a measured hand: any text, read as a CSV of times and positions.
#include <string>
#include <vector>

#include "app/file/scene/hand_file.h"
#include "app/file/text/text.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

Outcome fuzz_one(Bytes input) {
  const std::string origin = "fuzz.csv";
  const auto points = file::parse_hand(text_of(input), origin);
  if (!points) {
    require_one_clean_line(points.error(), origin);
    return Outcome::kRefused;
  }
  Scene scene;
  scene.x().hand.emplace().path = *points;
  scene.x().hand->path.file = "fuzz.csv";
  require(!validate(scene), "a hand that was read is one that a scene takes");
  std::string written(file::kHandHeader);
  for (const PathPoint& point : *points) {
    written += "\n" + file::shortest_number(point.time_s) + ",";
    file::append_number(written, point.position_m);
  }
  const auto again = file::parse_hand(written, "written.csv");
  require(again.ok() && *again == *points, "a hand that was written reads back the same");
  return Outcome::kTaken;
}

const Registered kRegistered({"hand", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
