#include "app/file/map_rows.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "app/file/text.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::file {
namespace {

struct Column {
  std::string_view name;
  std::optional<double> MapFigures::*value;
};
constexpr std::array<Column, kMapFigures> kColumns{
    {{"tail_peak_to_peak_m", &MapFigures::tail_peak_to_peak_m},
     {"tail_force_mean_n", &MapFigures::tail_force_mean_n},
     {"tail_force_std_n", &MapFigures::tail_force_std_n},
     {"displayed_stiffness_n_per_m", &MapFigures::displayed_stiffness_n_per_m},
     {"max_penetration_m", &MapFigures::max_penetration_m},
     {"passivity_margin_j", &MapFigures::passivity_margin_j}}};

std::optional<Verdict> find_verdict(std::string_view name) {
  for (const Verdict verdict : {Verdict::kSettled, Verdict::kOscillating, Verdict::kDiverged}) {
    if (verdict_name(verdict) == name) return verdict;
  }
  return std::nullopt;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

// False where the field is neither empty nor a number.
bool parse_field(std::string_view field, std::optional<double>& value) {
  if (field.empty()) return true;
  double number = 0.0;
  const char* end = field.data() + field.size();
  const auto [rest, code] = std::from_chars(field.data(), end, number);
  if (code != std::errc{} || rest != end || !std::isfinite(number)) return false;
  value = number;
  return true;
}

}  // namespace

std::string map_row_beginning(const StabilityMap& map, std::size_t cell) {
  const MapPlace at = map.place(cell);
  AlgorithmSettings algorithm = map.scene.algorithm;
  algorithm.index = map.algorithms.at(at.algorithm);
  return fmt::format("{},{},{},", algorithm_label(algorithm), number_text(map.x.value(at.x)),
                     number_text(map.y.value(at.y)));
}

std::string map_header(const StabilityMap& map) {
  std::string text = fmt::format("algorithm,{},{},verdict", map.x.number.path, map.y.number.path);
  for (const Column& column : kColumns) text += fmt::format(",{}", column.name);
  return text + '\n';
}

void append_map_row(std::string& text, const StabilityMap& map, std::size_t cell,
                    const MapFigures& figures) {
  text += map_row_beginning(map, cell);
  text += verdict_name(figures.verdict);
  for (const Column& column : kColumns) {
    text += ',';
    const std::optional<double>& value = figures.*column.value;
    if (value && std::isfinite(*value)) append_number(text, *value);
  }
  text += '\n';
}

std::optional<MapFigures> parse_map_row(std::string_view line, const StabilityMap& map,
                                        std::size_t cell) {
  const std::string place = map_row_beginning(map, cell);
  if (!line.starts_with(place)) return std::nullopt;
  const std::vector<std::string_view> fields = fields_of(line.substr(place.size()));
  const std::optional<Verdict> verdict = find_verdict(fields.front());
  if (!verdict || fields.size() != kColumns.size() + 1) return std::nullopt;
  MapFigures figures;
  figures.verdict = *verdict;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if (!parse_field(fields[i + 1], figures.*kColumns[i].value)) return std::nullopt;
  }
  return figures;
}

}  // namespace hapticwall::file
