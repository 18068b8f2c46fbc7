// A contact study as a table, as JSON and as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "app/command/compare_study.h"
#include "app/command/json_report.h"
#include "app/command/text_table.h"
#include "app/file/text.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

// In the order of RiseKind; all of a width, so that numbers stay below each other.
constexpr std::array<std::string_view, 3> kRiseMarks{"  ", " *", " +"};
constexpr std::array<std::string_view, 3> kRiseNames{"mean", "one-tick", "to-the-limit"};

bool has_islands(const ContactFigures& row) { return row.settled_ranges > 1; }

std::string stiffness_text(const std::optional<LargestStiffness>& figure) {
  if (!figure) return "-";
  return (figure->open_ended ? ">= " : "") + kilonewtons_per_metre(figure->displayed_n_per_m);
}
std::string wall_text(const std::optional<LargestStiffness>& figure) {
  return figure ? fixed(figure->wall_n_per_m, 1.0 / kNewtonsPerKilonewton, 1) : "-";
}

std::string buzz_text(const std::optional<LargestStiffness>& figure) {
  return figure ? fixed(figure->force_std_n, 1.0, 2) : "-";
}

bool rises(const ContactFigures& row, RiseKind kind) {
  return row.rate_hardness_n_per_m && row.rise_kind == kind;
}

std::string rate_hardness_text(const ContactFigures& row) {
  const RiseKind kind = row.rate_hardness_n_per_m ? row.rise_kind : RiseKind::kMean;
  return kilonewtons_per_metre(row.rate_hardness_n_per_m) +
         std::string(kRiseMarks.at(static_cast<std::size_t>(kind)));
}

struct StudyColumn {
  std::string_view title;
  std::string_view unit;
  std::string (*text)(const ContactFigures&);
  Align align = Align::kRight;
};

constexpr std::array<StudyColumn, 13> kStudyColumns{
    {{"algorithm", "", [](const ContactFigures& r) { return r.summary.algorithm; }, Align::kLeft},
     {"stiffest", "kN/m",
      [](const ContactFigures& r) { return stiffness_text(r.stiffest_unbroken); }},
     {"of a wall", "kN/m", [](const ContactFigures& r) { return wall_text(r.stiffest_unbroken); }},
     {"force", "+/- N", [](const ContactFigures& r) { return buzz_text(r.stiffest_unbroken); }},
     {"in islands", "kN/m",
      [](const ContactFigures& r) { return has_islands(r) ? stiffness_text(r.stiffest) : ""; }},
     {"of a wall", "kN/m",
      [](const ContactFigures& r) { return has_islands(r) ? wall_text(r.stiffest) : ""; }},
     {"force", "+/- N",
      [](const ContactFigures& r) { return has_islands(r) ? buzz_text(r.stiffest) : ""; }},
     {"rate-hardness  ", "kN/m  ", rate_hardness_text},
     {"rise time", "ms",
      [](const ContactFigures& r) { return fixed(r.rise_time_s, kMillisecondsPerSecond, 1); }},
     {"deepest", "mm",
      [](const ContactFigures& r) { return fixed(r.peak_penetration_m, kMillimetresPerMetre, 3); }},
     {"to the hand", "mJ",
      [](const ContactFigures& r) { return fixed(r.energy_to_hand_j, kMillijoulesPerJoule, 2); }},
     {"tail p-p", "mm",
      [](const ContactFigures& r) {
        return fixed(r.summary.tail_peak_to_peak_m, kMillimetresPerMetre, 3);
      }},
     {"verdict", "",
      [](const ContactFigures& r) { return std::string(verdict_name(r.summary.verdict)); },
      Align::kLeft}}};

// The scene's, and the scan's, for whoever reads the table alone.
std::string conditions_text(const ContactStudyPlan& plan, const std::vector<ContactFigures>& rows) {
  std::optional<double> speed;
  for (const ContactFigures& row : rows) {
    if (!speed) speed = row.approach_speed_m_per_s;
  }
  const MapAxis axis = plan.stiffnesses();
  return fmt::format(
      "{}{}: wall of {} kN/m, met at {} m/s, {:g} s\n"
      "stiffest: {} stiffnesses of the wall from {} to {} N/m, refined to {:g}\n\n",
      plan.scene.name, plan.scene.y ? ", axis x" : "",
      kilonewtons_per_metre(plan.scene.walls.front().stiffness_n_per_m), fixed(speed, 1.0, 3),
      plan.scene.duration_s, axis.count, file::number_text(axis.low), file::number_text(axis.high),
      plan.tolerance);
}

std::string marks_text(const std::vector<ContactFigures>& rows) {
  const auto any = [&](auto holds) { return std::ranges::any_of(rows, holds); };
  std::string text;
  if (any([](const ContactFigures& r) { return r.stiffest && r.stiffest->open_ended; })) {
    text += ">= settles up to the last stiffness that was tried\n";
  }
  if (any(has_islands)) {
    text += "in islands: of all walls that settle, also beyond softer ones that do not\n";
  }
  if (any([](const ContactFigures& r) { return rises(r, RiseKind::kOneTick); })) {
    text += "* one jump in one tick: tells where the wall lies between two counts of the encoder\n";
  }
  if (any([](const ContactFigures& r) { return rises(r, RiseKind::kToTheLimit); })) {
    text += "+ cut off by the force limit\n";
  }
  return text.empty() ? text : "\n" + text;
}

Json conditions_object(const ContactStudyPlan& plan) {
  const MapAxis axis = plan.stiffnesses();
  return {{"scene", plan.scene.name},
          {"duration_s", json_number(plan.scene.duration_s)},
          {"rate_hz", json_number(plan.scene.sampling.rate_hz)},
          {"wall_stiffness_n_per_m", json_number(plan.scene.walls.front().stiffness_n_per_m)},
          {"scan_low_n_per_m", json_number(axis.low)},
          {"scan_high_n_per_m", json_number(axis.high)},
          {"scan_count", axis.count},
          {"scan_tolerance", json_number(plan.tolerance)}};
}

// `figure` as four keys.
void add_stiffness(const std::string& prefix, const std::optional<LargestStiffness>& figure,
                   Json& object) {
  object[prefix + "stiffness_n_per_m"] = figure ? json_number(figure->displayed_n_per_m) : Json();
  object[prefix + "at_wall_n_per_m"] = figure ? json_number(figure->wall_n_per_m) : Json();
  object[prefix + "tail_force_std_n"] = figure ? json_number(figure->force_std_n) : Json();
  object[prefix + "reaches_end_of_scan"] = figure ? Json(figure->open_ended) : Json();
}

Json row_object(const ContactFigures& row) {
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

}  // namespace

std::string study_table(const ContactStudyPlan& plan, const std::vector<ContactFigures>& rows) {
  std::vector<std::vector<std::string>> cells(2 + rows.size());
  std::vector<Align> aligns;
  for (const StudyColumn& column : kStudyColumns) {
    aligns.push_back(column.align);
    cells[0].emplace_back(column.title);
    cells[1].emplace_back(column.unit);
    for (std::size_t i = 0; i < rows.size(); ++i) cells[2 + i].push_back(column.text(rows[i]));
  }
  return conditions_text(plan, rows) + aligned(cells, aligns) + marks_text(rows);
}

std::string study_json(const ContactStudyPlan& plan, const std::vector<ContactFigures>& rows) {
  Json object = conditions_object(plan);
  Json& list = object["rows"] = Json::array();
  for (const ContactFigures& row : rows) list.push_back(row_object(row));
  return json_text(object);
}

std::string study_csv(const ContactStudyPlan& plan, const std::vector<ContactFigures>& rows) {
  std::vector<Json> lines;
  for (const ContactFigures& row : rows) {
    Json& line = lines.emplace_back(conditions_object(plan));
    line.update(row_object(row));
  }
  return csv_text(lines);
}

}  // namespace hapticwall::command
