#include "app/ui/computed/map_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace hapticwall::ui {
namespace {

constexpr double kDecade = 10.0;
constexpr double kWholeValues = 11.0;
constexpr double kAroundPositionM = 0.02;

// Upper end of a range from 0 if the scene has no value to derive it from.
struct UsualSpan {
  std::string_view unit;
  double span;
};
constexpr std::array kUsualSpans{UsualSpan{"N/m", 1e4}, UsualSpan{"N·s/m", 10.0},
                                 UsualSpan{"m", 1e-3},  UsualSpan{"s", 0.01},
                                 UsualSpan{"N/s", 1e4}, UsualSpan{"N", 1.0}};

double usual_span(std::string_view unit) {
  const auto* found = std::ranges::find(kUsualSpans, unit, &UsualSpan::unit);
  return found != kUsualSpans.end() ? found->span : 1.0;
}

// Within the range of the number; whole numbers are each a value.
MapAxis within(const SceneNumber& number, double low, double high, bool logarithmic) {
  MapAxis axis{number, std::max(low, number.range.minimum), std::min(high, number.range.maximum),
               kLiveMapValues, logarithmic};
  if (number.whole) axis.count = static_cast<std::size_t>(axis.high - axis.low) + 1;
  return axis;
}

const SceneNumber& number_called(const std::vector<SceneNumber>& numbers, const std::string& path,
                                 std::size_t otherwise) {
  const auto found = std::ranges::find(numbers, path, &SceneNumber::path);
  return found != numbers.end() ? *found : numbers.at(otherwise);
}

MapAxis axis_of(MapAxisChoice& choice, const SceneNumber& number, const Scene& scene) {
  if (choice.path != number.path) choose_number(choice, number.path);
  const std::optional<double> value = number.get(scene);
  const bool left =
      choice.range && value && (*value < choice.range->low || *value > choice.range->high);
  if (!choice.range || (left && !choice.typed)) choice.range = axis_around(number, value);
  return *choice.range;
}

bool same_axis(const MapAxis& a, const MapAxis& b) {
  return a.number.path == b.number.path && a.low == b.low && a.high == b.high &&
         a.count == b.count && a.logarithmic == b.logarithmic;
}

}  // namespace

std::vector<SceneNumber> map_numbers(const Scene& scene) {
  std::vector<SceneNumber> numbers = scene_numbers(scene);
  std::erase_if(numbers, [](const SceneNumber& number) { return number.path == "duration_s"; });
  return numbers;
}

MapAxis axis_around(const SceneNumber& number, std::optional<double> value) {
  const double at = value.value_or(0.0);
  if (number.whole) {
    const double low = std::max(number.range.minimum, at - std::floor(0.5 * kWholeValues));
    return within(number, low, low + kWholeValues - 1.0, false);
  }
  if (number.range.minimum < 0.0) {
    return within(number, at - kAroundPositionM, at + kAroundPositionM, false);
  }
  if (at > 0.0) return within(number, at / kDecade, at * kDecade, true);
  const double span = usual_span(number.unit);
  const bool excluded = number.range.minimum_excluded;
  const double low = excluded ? span / static_cast<double>(kLiveMapValues) : 0.0;
  // A range that begins beyond the usual span is shown for a decade.
  const double high = number.range.minimum < span ? span : kDecade * number.range.minimum;
  return within(number, low, high, false);
}

std::optional<std::string> set_range(MapAxisChoice& choice, double low, double high,
                                     bool logarithmic) {
  MapAxis& axis = *choice.range;
  for (const double end : {low, high}) {
    if (!axis.number.range.contains(end))
      return out_of_range_text(end, axis.number.range, axis.number.unit);
    if (axis.number.whole && end != std::round(end))
      return fmt::format("{} is no whole number", number_text(end));
  }
  if (!(low < high)) return "the map's left or lower end must be less than the other one";
  if (logarithmic && low <= 0.0) return "a logarithmic axis begins above 0";
  const MapAxis wanted = within(axis.number, low, high, logarithmic);
  if (wanted.count > kLiveMapValues) return fmt::format("at most {} values", kLiveMapValues);
  axis = wanted;
  choice.typed = true;
  return std::nullopt;
}

void choose_number(MapAxisChoice& choice, const std::string& path) { choice = {path}; }

void choose_algorithm_in_map(MapChoice& choice, std::size_t index, bool chosen) {
  std::erase(choice.algorithms, index);
  if (chosen) choice.algorithms.push_back(index);
  std::ranges::sort(choice.algorithms);
}

StabilityMap map_of(MapChoice& choice, const Scene& scene) {
  const std::vector<SceneNumber> numbers = map_numbers(scene);
  StabilityMap map;
  map.scene = scene;
  map.algorithms = choice.algorithms;
  if (map.algorithms.empty()) map.algorithms.push_back(scene.algorithm.index);
  auto& [x, y] = choice.axes;
  map.x = axis_of(x, number_called(numbers, x.path, 0), scene);
  const std::size_t other = numbers.front().path == x.path ? 1 : 0;
  if (y.path == x.path) choose_number(y, numbers.at(other).path);
  map.y = axis_of(y, number_called(numbers, y.path, other), scene);
  return map;
}

bool same_cells(const StabilityMap& a, const StabilityMap& b) {
  if (a.algorithms != b.algorithms || !same_axis(a.x, b.x) || !same_axis(a.y, b.y)) return false;
  return a.scene_at(0) == b.scene_at(0);
}

}  // namespace hapticwall::ui
