#include "app/command/map/map_report.h"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <optional>

#include "app/file/text/text.h"
#include "app/table/json_report.h"
#include "app/table/text_table.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

table::Json axis_object(const MapAxis& axis) {
  return {{"key", axis.number.path},
          {"low", axis.low},
          {"high", axis.high},
          {"count", axis.count},
          {"logarithmic", axis.logarithmic}};
}

std::string label_of(const Scene& scene, std::size_t algorithm) {
  AlgorithmSettings settings = scene.algorithm;
  settings.index = algorithm;
  return algorithm_label(settings);
}

// Cells of one algorithm, by verdict.
struct Counts {
  std::array<std::size_t, kVerdictNames.size()> of{};

  [[nodiscard]] std::size_t all() const {
    return std::accumulate(of.begin(), of.end(), std::size_t{0});
  }
};

std::vector<Counts> counts_of(const StabilityMap& map, std::size_t begin,
                              std::span<const MapMetrics> metrics) {
  std::vector<Counts> counts(map.algorithms.size());
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    Counts& of_algorithm = counts.at(map.place(begin + i).algorithm);
    ++of_algorithm.of.at(static_cast<std::size_t>(metrics[i].verdict));
  }
  return counts;
}

std::string axis_text(const MapAxis& axis) {
  return fmt::format("{} from {} to {} {} in {} {}", axis.number.path,
                     file::shortest_number(axis.low), file::shortest_number(axis.high),
                     axis.number.unit, axis.count,
                     axis.logarithmic ? "equal ratios" : "equal steps");
}

std::string significant(std::optional<double> value) {
  return value ? fmt::format("{:.6g}", *value) : "-";
}

std::vector<std::string> boundary_row(const BoundaryPlan& plan, const Boundary& boundary) {
  std::vector<std::string> row{label_of(plan.scene, plan.algorithms.at(boundary.algorithm))};
  if (plan.x) row.push_back(significant(boundary.x));
  for (const auto& value : {boundary.settled.first, boundary.settled.last, boundary.failed.first,
                            boundary.failed.last}) {
    row.push_back(significant(value));
  }
  row.push_back(table::changes_text(boundary.changes));
  const std::optional<Summary>& there = boundary.at_settled;
  row.push_back(file::fixed(there ? there->displayed_stiffness_n_per_m : std::nullopt,
                            1.0 / kNewtonsPerKilonewton, 3));
  row.push_back(
      file::fixed(there ? there->tail_peak_to_peak_m : std::nullopt, kMillimetresPerMetre, 4));
  return row;
}

std::vector<std::vector<std::string>> boundary_heading(const BoundaryPlan& plan) {
  std::vector<std::string> titles{"algorithm"};
  std::vector<std::string> units{""};
  const auto add = [&](std::string title, std::string unit) {
    titles.push_back(std::move(title));
    units.push_back(std::move(unit));
  };
  if (plan.x) add(plan.x->number.path, plan.x->number.unit);
  for (const char* title : {"first settled", "last settled", "first failure", "last failure"}) {
    add(title, plan.along.number.unit);
  }
  add("changes  ", "");
  add("stiffness", "kN/m");
  add("tail p-p", "mm");
  return {titles, units};
}

}  // namespace

std::string map_table(const StabilityMap& map, std::size_t begin,
                      std::span<const MapMetrics> metrics) {
  std::vector<std::vector<std::string>> rows{{"algorithm", "cells"}, {"", ""}};
  for (const std::string_view verdict : kVerdictNames) {
    rows[0].emplace_back(verdict);
    rows[1].emplace_back("%");
  }
  const std::vector<Counts> counts = counts_of(map, begin, metrics);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t all = counts[i].all();
    if (all == 0) continue;
    rows.push_back({label_of(map.scene, map.algorithms[i]), fmt::format("{}", all)});
    for (const std::size_t cells : counts[i].of) {
      rows.back().push_back(
          fmt::format("{:.1f}", kPercent * static_cast<double>(cells) / static_cast<double>(all)));
    }
  }
  std::array<table::Align, 2 + kVerdictNames.size()> aligns{};
  aligns.front() = table::Align::kLeft;
  return fmt::format("{}\nx: {}\ny: {}\n\n", map.scene.name, axis_text(map.x), axis_text(map.y)) +
         table::aligned(rows, aligns);
}

std::string map_json(const StabilityMap& map, std::size_t begin,
                     std::span<const MapMetrics> metrics) {
  table::Json object{{"scene", map.scene.name},
                     {"x", axis_object(map.x)},
                     {"y", axis_object(map.y)},
                     {"first_cell", begin},
                     {"cells", metrics.size()}};
  table::Json& list = object["algorithms"] = table::Json::array();
  const std::vector<Counts> counts = counts_of(map, begin, metrics);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].all() == 0) continue;
    table::Json& row = list.emplace_back(table::Json{
        {"algorithm", label_of(map.scene, map.algorithms[i])}, {"cells", counts[i].all()}});
    for (std::size_t verdict = 0; verdict < kVerdictNames.size(); ++verdict) {
      row[std::string(kVerdictNames[verdict])] = counts[i].of[verdict];
    }
  }
  return table::json_text(object);
}

std::string boundary_table(const BoundaryPlan& plan, const std::vector<Boundary>& boundaries) {
  std::vector<std::vector<std::string>> rows = boundary_heading(plan);
  bool islands = false;
  for (const Boundary& boundary : boundaries) {
    rows.push_back(boundary_row(plan, boundary));
    islands = islands || boundary.changes > 1;
  }
  std::vector<table::Align> aligns(rows.front().size(), table::Align::kRight);
  aligns.front() = table::Align::kLeft;
  std::string text = fmt::format("{}, along {}, to {:g} of the value\n\n", plan.scene.name,
                                 axis_text(plan.along), plan.tolerance) +
                     table::aligned(rows, aligns);
  if (islands) text += fmt::format("\n{}", table::kManyChangesNote);
  return text;
}

std::string boundary_json(const BoundaryPlan& plan, const std::vector<Boundary>& boundaries) {
  table::Json object{{"scene", plan.scene.name},
                     {"along", axis_object(plan.along)},
                     {"tolerance", plan.tolerance}};
  if (plan.x) object["x"] = axis_object(*plan.x);
  table::Json& list = object["boundaries"] = table::Json::array();
  for (const Boundary& boundary : boundaries)
    list.push_back(table::boundary_object(plan, boundary));
  return table::json_text(object);
}

std::string boundary_csv(const BoundaryPlan& plan, const std::vector<Boundary>& boundaries) {
  std::vector<table::Json> lines;
  lines.reserve(boundaries.size());
  for (const Boundary& boundary : boundaries)
    lines.push_back(table::boundary_object(plan, boundary));
  return table::csv_text(lines);
}

}  // namespace hapticwall::command
