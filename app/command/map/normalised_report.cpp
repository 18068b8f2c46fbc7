// The normalised chart as table, JSON and CSV.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/command/map/map_report.h"
#include "app/table/json_report.h"
#include "app/table/text_table.h"

namespace hapticwall::command {
namespace {

struct Row {
  int delay_ticks;
  double unit_n_s_per_m;  // B at B T/m = 1
  double unit_n_per_m;    // K at K T²/m = 1
  SimulatedPoint point;
};

std::vector<Row> rows_of(const NormalisedChart& chart) {
  const double rate_hz = chart.handle.sampling.rate_hz;
  const double damping_unit = chart.handle.x().device.mass_kg * rate_hz;
  std::vector<Row> rows;
  for (const DelayChart& delay : chart.delays) {
    for (const SimulatedPoint& point : delay.points) {
      rows.push_back({delay.ticks, damping_unit, damping_unit * rate_hz, point});
    }
  }
  return rows;
}

constexpr std::array<table::Column<Row>, 8> kColumns{
    {{"delay", "ticks", [](const Row& r) { return fmt::format("{}", r.delay_ticks); }},
     {"B", "N·s/m", [](const Row& r) { return file::fixed(r.point.damping, r.unit_n_s_per_m, 2); }},
     {"limit", "N/m",
      [](const Row& r) { return fmt::format("{:.5g}", r.point.limit * r.unit_n_per_m); }},
     {"B T/m", "", [](const Row& r) { return file::fixed(r.point.damping, 1.0, 4); }},
     {"limit", "K T²/m", [](const Row& r) { return file::fixed(r.point.limit, 1.0, 5); }},
     {"settles", "K T²/m", [](const Row& r) { return file::fixed(r.point.settled, 1.0, 5); }},
     {"fails", "K T²/m", [](const Row& r) { return file::fixed(r.point.failed, 1.0, 5); }},
     {"rule", "K T²/m", [](const Row& r) { return file::fixed(r.point.rule, 1.0, 5); }}}};

table::Json head_of(const NormalisedChart& chart) {
  const DeviceSettings& device = chart.handle.x().device;
  return {{"scene", chart.handle.name},
          {"rate_hz", chart.handle.sampling.rate_hz},
          {"mass_kg", device.mass_kg},
          {"damping_n_s_per_m", device.damping_n_s_per_m},
          {"normalised_device_damping", chart.device_damping}};
}

std::vector<table::Json> objects_of(const NormalisedChart& chart) {
  std::vector<table::Json> objects;
  for (const Row& row : rows_of(chart)) {
    const SimulatedPoint& point = row.point;
    objects.push_back({{"delay_ticks", row.delay_ticks},
                       {"wall_damping_n_s_per_m", point.damping * row.unit_n_s_per_m},
                       {"limit_n_per_m", point.limit * row.unit_n_per_m},
                       {"normalised_damping", point.damping},
                       {"normalised_limit", point.limit},
                       {"normalised_settled", table::json_number(point.settled)},
                       {"normalised_failed", table::json_number(point.failed)},
                       {"normalised_rule", point.rule},
                       {"changes", point.changes}});
  }
  return objects;
}

}  // namespace

std::string normalised_table(const NormalisedChart& chart) {
  const std::vector<Row> rows = rows_of(chart);
  const DeviceSettings& device = chart.handle.x().device;
  std::string text =
      fmt::format("{}: handle of {:g} kg and {:g} N·s/m at {:g} Hz, b T/m = {:.4g}, no hand\n",
                  chart.handle.name, device.mass_kg, device.damping_n_s_per_m,
                  chart.handle.sampling.rate_hz, chart.device_damping);
  for (const DelayChart& delay : chart.delays) {
    text += fmt::format(
        "delay {}: stiffest wall K T²/m = {:.4g} at B T/m = {:.3g}; beyond B T/m = {:.3g} no wall "
        "is stable\n",
        delay.ticks, delay.best.limit, delay.best.damping, delay.last_damping);
  }
  text += "\n" + table::sheet_text(table::sheet_of(kColumns, rows));
  if (std::ranges::any_of(rows, [](const Row& row) { return row.point.changes > 1; })) {
    text += "\nthe verdict changes more than once along a scan: see --json\n";
  }
  return text;
}

std::string normalised_json(const NormalisedChart& chart) {
  table::Json head = head_of(chart);
  table::Json& delays = head["delays"] = table::Json::array();
  for (const DelayChart& delay : chart.delays) {
    delays.push_back({{"delay_ticks", delay.ticks},
                      {"normalised_best_damping", delay.best.damping},
                      {"normalised_best_limit", delay.best.limit},
                      {"normalised_last_damping", delay.last_damping},
                      {"normalised_pressing_stiffness", delay.pressing}});
  }
  return table::study_json_text(std::move(head), objects_of(chart));
}

std::string normalised_csv(const NormalisedChart& chart) {
  return table::study_csv_text(head_of(chart), objects_of(chart));
}

}  // namespace hapticwall::command
