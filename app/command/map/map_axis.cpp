#include "app/command/map_axis.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "app/file/text.h"

namespace hapticwall::command {
namespace {

constexpr std::string_view kForm =
    "it takes KEY=LO:HI:N, or KEY=LO:HI:N:log, as in wall.stiffness_n_per_m=1e3:1e5:100:log";

template <typename Number>
bool parse(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  return code == std::errc{} && rest == end;
}

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t colon = text.find(':');
    parts.push_back(text.substr(0, colon));
    if (colon == std::string_view::npos) return parts;
    text.remove_prefix(colon + 1);
  }
}

// The range alone; false where the text has another form.
bool parse_range(std::string_view text, MapAxis& axis) {
  constexpr std::size_t kPlain = 3;
  const std::vector<std::string_view> parts = parts_of(text);
  axis.logarithmic = parts.size() == kPlain + 1 && parts.back() == "log";
  if (parts.size() != kPlain && !axis.logarithmic) return false;
  return parse(parts[0], axis.low) && parse(parts[1], axis.high) && parse(parts[2], axis.count) &&
         std::isfinite(axis.low) && std::isfinite(axis.high);
}

// What is wrong with a range of this form, or "".
std::string problem_of(const MapAxis& axis) {
  if (!(axis.low < axis.high)) return "LO is not below HI";
  if (axis.count < 2 || axis.count > kMostMapValues) {
    return fmt::format("N is {}; it takes 2 to {}", axis.count, kMostMapValues);
  }
  if (axis.logarithmic && axis.low <= 0.0) return "with log, LO is more than 0";
  for (std::size_t i = 0; axis.number.whole && i < axis.count; ++i) {
    if (axis.value(i) != std::round(axis.value(i))) {
      return fmt::format("the key counts, and value {} of these is {}; it takes whole numbers",
                         i + 1, file::number_text(axis.value(i)));
    }
  }
  return "";
}

std::string unknown_key(std::string_view key, const Scene& scene) {
  std::vector<std::string_view> paths;
  const std::vector<SceneNumber> numbers = scene_numbers(scene);
  paths.reserve(numbers.size());
  for (const SceneNumber& number : numbers) paths.push_back(number.path);
  return fmt::format("no number of this scene is called {}{}; known: {}", file::in_quotes(key),
                     file::suggestion(key, paths), file::joined(paths));
}

}  // namespace

Result<MapAxis> parse_map_axis(const std::string& option, const std::string& text,
                               const Scene& scene) {
  const auto wrong = [&](std::string_view why) {
    return Error{ErrorKind::kUsage, fmt::format("{} {}: {}", option, file::shown(text), why)};
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return wrong(kForm);
  const std::string_view key = std::string_view(text).substr(0, equals);
  std::optional<SceneNumber> number = find_scene_number(scene, key);
  if (!number) return wrong(unknown_key(key, scene));
  MapAxis axis;
  axis.number = std::move(*number);
  if (!parse_range(std::string_view(text).substr(equals + 1), axis)) return wrong(kForm);
  if (const std::string problem = problem_of(axis); !problem.empty()) return wrong(problem);
  return axis;
}

}  // namespace hapticwall::command
