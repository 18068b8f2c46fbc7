#include "app/command/map/map_axis.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

constexpr std::string_view kForm =
    "it takes KEY=LO:HI:N, or KEY=LO:HI:N:log, as in wall.stiffness_n_per_m=1e3:1e5:100:log";

// The range alone; false if the text has another form.
bool parse_range(std::string_view text, MapAxis& axis) {
  constexpr std::size_t kPlain = 3;
  const std::vector<std::string_view> parts = file::split(text, ':');
  axis.logarithmic = parts.size() == kPlain + 1 && parts.back() == "log";
  if (parts.size() != kPlain && !axis.logarithmic) return false;
  const auto low = file::parsed<double>(parts[0]);
  const auto high = file::parsed<double>(parts[1]);
  const auto count = file::parsed<std::size_t>(parts[2]);
  if (!low || !high || !count) return false;
  axis.low = *low;
  axis.high = *high;
  axis.count = *count;
  return true;
}

// The problem of a range of this form, or "".
std::string problem_of(const MapAxis& axis) {
  if (!(axis.low < axis.high)) return "LO is not below HI";
  if (axis.count < 2 || axis.count > kMaxMapValues) {
    return fmt::format("N is {}; it takes 2 to {}", axis.count, kMaxMapValues);
  }
  if (axis.logarithmic && axis.low <= 0.0) return "with log, LO is more than 0";
  for (std::size_t i = 0; axis.number.whole && i < axis.count; ++i) {
    if (axis.value(i) != std::round(axis.value(i))) {
      return fmt::format("the key counts, and value {} of these is {}; it takes whole numbers",
                         i + 1, file::shortest_number(axis.value(i)));
    }
  }
  return "";
}

std::string unknown_key(std::string_view key, const Scene& scene) {
  const std::vector<SceneNumber> numbers = scene_numbers(scene);
  const auto paths = file::names_of(numbers, &SceneNumber::path);
  const std::string nearest = file::suggestion(key, paths);
  return fmt::format("no number of this scene is called {}{}", file::in_quotes(key),
                     nearest.empty() ? fmt::format("; known: {}", file::joined(paths)) : nearest);
}

}  // namespace

Result<MapAxis> parse_map_axis(const std::string& option, const std::string& text,
                               const Scene& scene) {
  const auto wrong = [&](std::string_view why) {
    return usage_error(fmt::format("{} {}: {}", option, file::shown(text), why));
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
