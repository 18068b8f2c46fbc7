#include "app/file/map/map_rows.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::file {
namespace {

struct Column {
  std::string_view name;
  std::optional<double> MapMetrics::*value;
};
constexpr std::array<Column, kMapMetrics> kColumns{
    {{"tail_peak_to_peak_m", &MapMetrics::tail_peak_to_peak_m},
     {"tail_force_mean_n", &MapMetrics::tail_force_mean_n},
     {"tail_force_std_n", &MapMetrics::tail_force_std_n},
     {"displayed_stiffness_n_per_m", &MapMetrics::displayed_stiffness_n_per_m},
     {"max_penetration_m", &MapMetrics::max_penetration_m},
     {"passivity_margin_j", &MapMetrics::passivity_margin_j}}};

}  // namespace

std::string map_row_beginning(const StabilityMap& map, std::size_t cell) {
  const MapPlace at = map.place(cell);
  AlgorithmSettings algorithm = map.scene.algorithm;
  algorithm.index = map.algorithms.at(at.algorithm);
  return fmt::format("{},{},{},", algorithm_label(algorithm), shortest_number(map.x.value(at.x)),
                     shortest_number(map.y.value(at.y)));
}

std::string map_header(const StabilityMap& map) {
  std::string text = fmt::format("algorithm,{},{},verdict", map.x.number.path, map.y.number.path);
  for (const Column& column : kColumns) text += fmt::format(",{}", column.name);
  return text + '\n';
}

void append_map_row(std::string& text, const StabilityMap& map, std::size_t cell,
                    const MapMetrics& metrics) {
  text += map_row_beginning(map, cell);
  text += verdict_name(metrics.verdict);
  for (const Column& column : kColumns) {
    text += ',';
    const std::optional<double>& value = metrics.*column.value;
    if (value && std::isfinite(*value)) append_number(text, *value);
  }
  text += '\n';
}

std::optional<MapMetrics> parse_map_row(std::string_view line, const StabilityMap& map,
                                        std::size_t cell) {
  const std::string beginning = map_row_beginning(map, cell);
  std::string_view place = beginning;
  const AlgorithmDescription& algorithm = algorithms()[map.algorithms[map.place(cell).algorithm]];
  if (!algorithm.old_name.empty() && line.starts_with(algorithm.old_name)) {
    line.remove_prefix(algorithm.old_name.size());
    place.remove_prefix(algorithm.name.size());
  }
  if (!line.starts_with(place)) return std::nullopt;
  const std::vector<std::string_view> fields = split(line.substr(place.size()), ',');
  const std::optional<Verdict> verdict = find_verdict(fields.front());
  if (!verdict || fields.size() != kColumns.size() + 1) return std::nullopt;
  MapMetrics metrics;
  metrics.verdict = *verdict;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const std::string_view field = fields[i + 1];
    if (field.empty()) continue;
    std::optional<double>& value = metrics.*kColumns[i].value;
    value = parsed<double>(field);
    if (!value) return std::nullopt;
  }
  return metrics;
}

}  // namespace hapticwall::file
