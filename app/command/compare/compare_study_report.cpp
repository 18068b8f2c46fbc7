// A contact study as a table, as JSON and as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "app/command/compare/compare_study.h"
#include "app/command/report/json_report.h"
#include "app/command/report/text_table.h"
#include "app/file/text/text.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

// In the order of RiseKind; of equal width, to align the numbers.
constexpr std::array<std::string_view, 3> kRiseMarks{"  ", " *", " +"};
constexpr std::array<std::string_view, 3> kRiseNames{"mean", "one-tick", "to-the-limit"};

bool has_islands(const ContactMetrics& row) { return row.settled_ranges > 1; }

std::string displayed_text(const std::optional<LargestStiffness>& largest) {
  if (!largest) return "-";
  return (largest->open_ended ? ">= " : "") + kilonewtons_per_metre(largest->displayed_n_per_m);
}
std::string wall_text(const std::optional<LargestStiffness>& largest) {
  return largest ? fixed(largest->wall_n_per_m, 1.0 / kNewtonsPerKilonewton, 1) : "-";
}

std::string buzz_text(const std::optional<LargestStiffness>& largest) {
  return largest ? fixed(largest->force_std_n, 1.0, 2) : "-";
}

bool rises(const ContactMetrics& row, RiseKind kind) {
  return row.rate_hardness_n_per_m && row.rise_kind == kind;
}

std::string rate_hardness_text(const ContactMetrics& row) {
  const RiseKind kind = row.rate_hardness_n_per_m ? row.rise_kind : RiseKind::kMean;
  return kilonewtons_per_metre(row.rate_hardness_n_per_m) +
         std::string(kRiseMarks.at(static_cast<std::size_t>(kind)));
}

constexpr std::array<TableColumn<ContactMetrics>, 13> kStudyColumns{
    {{"algorithm", "", [](const ContactMetrics& r) { return r.summary.algorithm; }, Align::kLeft},
     {"stiffest", "kN/m",
      [](const ContactMetrics& r) { return displayed_text(r.stiffest_unbroken); }},
     {"of a wall", "kN/m", [](const ContactMetrics& r) { return wall_text(r.stiffest_unbroken); }},
     {"force", "+/- N", [](const ContactMetrics& r) { return buzz_text(r.stiffest_unbroken); }},
     {"in islands", "kN/m",
      [](const ContactMetrics& r) { return has_islands(r) ? displayed_text(r.stiffest) : ""; }},
     {"of a wall", "kN/m",
      [](const ContactMetrics& r) { return has_islands(r) ? wall_text(r.stiffest) : ""; }},
     {"force", "+/- N",
      [](const ContactMetrics& r) { return has_islands(r) ? buzz_text(r.stiffest) : ""; }},
     {"rate-hardness  ", "kN/m  ", rate_hardness_text},
     {"rise time", "ms",
      [](const ContactMetrics& r) { return fixed(r.rise_time_s, kMillisecondsPerSecond, 1); }},
     {"deepest", "mm",
      [](const ContactMetrics& r) { return fixed(r.peak_penetration_m, kMillimetresPerMetre, 3); }},
     {"to the hand", "mJ",
      [](const ContactMetrics& r) { return fixed(r.energy_to_hand_j, kMillijoulesPerJoule, 2); }},
     {"tail p-p", "mm",
      [](const ContactMetrics& r) {
        return fixed(r.summary.tail_peak_to_peak_m, kMillimetresPerMetre, 3);
      }},
     {"verdict", "",
      [](const ContactMetrics& r) { return std::string(verdict_name(r.summary.verdict)); },
      Align::kLeft}}};

// Conditions of the scene and the scan.
std::string conditions_text(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  std::optional<double> speed;
  for (const ContactMetrics& row : rows) {
    if (!speed) speed = row.approach_speed_m_per_s;
  }
  const MapAxis axis = plan.stiffnesses();
  return fmt::format(
      "{}{}: wall of {} kN/m, met at {} m/s, {:g} s\n"
      "stiffest: {} stiffnesses of the wall from {} to {} N/m, refined to {:g}\n\n",
      plan.scene.name, plan.scene.two_axes() ? ", axis x" : "",
      kilonewtons_per_metre(plan.scene.x().walls.front().stiffness_n_per_m), fixed(speed, 1.0, 3),
      plan.scene.duration_s, axis.count, file::shortest_number(axis.low),
      file::shortest_number(axis.high), plan.tolerance);
}

std::string marks_text(const std::vector<ContactMetrics>& rows) {
  const auto any = [&](auto holds) { return std::ranges::any_of(rows, holds); };
  std::string text;
  if (any([](const ContactMetrics& r) { return r.stiffest && r.stiffest->open_ended; })) {
    text += ">= settles up to the largest stiffness of the scan\n";
  }
  if (any(has_islands)) {
    text += "in islands: of all walls that settle, also above softer walls that do not\n";
  }
  if (any([](const ContactMetrics& r) { return rises(r, RiseKind::kOneTick); })) {
    text +=
        "* one jump in one tick: depends on the position of the wall between two encoder counts\n";
  }
  if (any([](const ContactMetrics& r) { return rises(r, RiseKind::kToTheLimit); })) {
    text += "+ limited by the force limit\n";
  }
  return text.empty() ? text : "\n" + text;
}

Json conditions_object(const ContactStudyPlan& plan) {
  const MapAxis axis = plan.stiffnesses();
  return {{"scene", plan.scene.name},
          {"duration_s", json_number(plan.scene.duration_s)},
          {"rate_hz", json_number(plan.scene.sampling.rate_hz)},
          {"wall_stiffness_n_per_m", json_number(plan.scene.x().walls.front().stiffness_n_per_m)},
          {"scan_low_n_per_m", json_number(axis.low)},
          {"scan_high_n_per_m", json_number(axis.high)},
          {"scan_count", axis.count},
          {"scan_tolerance", json_number(plan.tolerance)}};
}

// `largest` as four keys.
void add_stiffness(const std::string& prefix, const std::optional<LargestStiffness>& largest,
                   Json& object) {
  object[prefix + "stiffness_n_per_m"] = largest ? json_number(largest->displayed_n_per_m) : Json();
  object[prefix + "at_wall_n_per_m"] = largest ? json_number(largest->wall_n_per_m) : Json();
  object[prefix + "tail_force_std_n"] = largest ? json_number(largest->force_std_n) : Json();
  object[prefix + "reaches_end_of_scan"] = largest ? Json(largest->open_ended) : Json();
}

Json row_object(const ContactMetrics& row) {
  Json object{{"algorithm", row.summary.algorithm}};
  add_stiffness("unbroken_", row.stiffest_unbroken, object);
  add_stiffness("largest_", row.stiffest, object);
  object["settled_ranges"] = row.settled_ranges;
  object["approach_speed_m_per_s"] = json_number(row.approach_speed_m_per_s);
  object["rate_hardness_n_per_m"] = json_number(row.rate_hardness_n_per_m);
  object["rate_hardness_of"] = row.rate_hardness_n_per_m
                                   ? Json(kRiseNames.at(static_cast<std::size_t>(row.rise_kind)))
                                   : Json();
  object["rise_time_s"] = json_number(row.rise_time_s);
  object["peak_penetration_m"] = json_number(row.peak_penetration_m);
  object["energy_to_hand_j"] = json_number(row.energy_to_hand_j);
  object["verdict"] = verdict_name(row.summary.verdict);
  object["tail_peak_to_peak_m"] = json_number(row.summary.tail_peak_to_peak_m);
  return object;
}

std::vector<Json> row_objects(const std::vector<ContactMetrics>& rows) {
  std::vector<Json> objects;
  for (const ContactMetrics& row : rows) objects.push_back(row_object(row));
  return objects;
}

}  // namespace

std::string study_table(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  return conditions_text(plan, rows) + table_of(kStudyColumns, rows) + marks_text(rows);
}

std::string study_json(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  return study_json_text(conditions_object(plan), row_objects(rows));
}

std::string study_csv(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  return study_csv_text(conditions_object(plan), row_objects(rows));
}

}  // namespace hapticwall::command
