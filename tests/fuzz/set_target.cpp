// --set: texts that change a scene, one after the other; a zero byte stands between two.
#include <span>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

constexpr std::string_view kOneWall =
    "[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1\n"
    "[hand]\nstiffness_n_per_m = 100\ndamping_n_s_per_m = 1\npath = [[0, 0.06]]\n"
    "[[wall]]\nposition_m = 0.05\nstiffness_n_per_m = 1000\n";
constexpr std::string_view kSecondWall = "[[wall]]\nposition_m = 0.055\nstiffness_n_per_m = 2000\n";

std::vector<std::string> arguments_of(std::string_view text) {
  std::vector<std::string> arguments;
  for (std::size_t end = text.find('\0'); end != std::string_view::npos; end = text.find('\0')) {
    arguments.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  arguments.emplace_back(text);
  return arguments;
}

Outcome with_overrides(const std::string& scene, std::span<const std::string> overrides) {
  const std::string origin = "fuzz.toml";
  const Result<file::LoadedScene> loaded = file::parse_scene(scene, origin, overrides);
  if (!loaded) {
    const bool of_scene = loaded.error().message.starts_with(origin);
    require_one_clean_line(loaded.error(), of_scene ? origin : "--set ");
    return Outcome::kRefused;
  }
  require(!validate(loaded->scene), "a scene that was taken is valid");
  return Outcome::kTaken;
}

Outcome fuzz_one(Bytes input) {
  static const std::string kBase(kOneWall);
  static const std::string kTwoWalls = kBase + std::string(kSecondWall);
  const std::vector<std::string> overrides = arguments_of(text_of(input));
  const Outcome of_two = with_overrides(kTwoWalls, overrides);
  const Outcome of_one = with_overrides(kBase, overrides);
  return of_two == Outcome::kTaken ? of_two : of_one;
}

const Registered kRegistered({"set", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
