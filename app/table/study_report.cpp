#include "app/table/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "app/file/text/text.h"
#include "app/table/json_report.h"
#include "core/units.h"

namespace hapticwall::table {
namespace {

// In the order of RiseKind; of equal width, to align the numbers.
constexpr std::array<std::string_view, 3> kRiseMarks{"  ", " *", " +"};
constexpr std::array<std::string_view, 3> kRiseNames{"mean", "one-tick", "to-the-limit"};

// A number of the run below the first failure.
std::optional<double> of_stiffest(const ContactMetrics& row, std::optional<double> Summary::*key) {
  const std::optional<Summary> run = row.stiffest();
  return run ? (*run).*key : std::nullopt;
}

bool rises(const ContactMetrics& row, RiseKind kind) {
  return row.rate_hardness_n_per_m && row.rise_kind == kind;
}

std::string rate_hardness_text(const ContactMetrics& row) {
  const RiseKind kind = row.rate_hardness_n_per_m ? row.rise_kind : RiseKind::kMean;
  return kilonewtons_per_metre(row.rate_hardness_n_per_m) +
         std::string(kRiseMarks.at(static_cast<std::size_t>(kind)));
}

constexpr std::array<Column<ContactMetrics>, 12> kStudyColumns{
    {{"algorithm", "", [](const ContactMetrics& r) { return r.summary.algorithm; }, Align::kLeft},
     {"stiffest", "kN/m",
      [](const ContactMetrics& r) {
        return kilonewtons_per_metre(of_stiffest(r, &Summary::displayed_stiffness_n_per_m));
      }},
     {"force", "+/- N",
      [](const ContactMetrics& r) {
        return fixed(of_stiffest(r, &Summary::tail_force_std_n), 1.0, 2);
      }},
     {"first failure", "kN/m",
      [](const ContactMetrics& r) { return kilonewtons_per_metre(r.limits.failed.first); }},
     {"last settled", "kN/m",
      [](const ContactMetrics& r) { return kilonewtons_per_metre(r.limits.settled.last); }},
     {"changes  ", "", [](const ContactMetrics& r) { return changes_text(r.limits.changes); }},
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
std::string study_heading(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  std::optional<double> speed;
  for (const ContactMetrics& row : rows) {
    if (!speed) speed = row.approach_speed_m_per_s;
  }
  const MapAxis axis = plan.stiffnesses();
  std::string text = fmt::format(
      "{}{}: wall of {} kN/m, met at {} m/s, {:g} s\n"
      "limits: {} stiffnesses of the wall from {} to {} N/m in steps of {:.2g} %, refined to "
      "{:g}\n",
      plan.scene.name, plan.scene.two_axes() ? ", axis x" : "",
      kilonewtons_per_metre(plan.scene.x().walls.front().stiffness_n_per_m), fixed(speed, 1.0, 3),
      plan.scene.duration_s, axis.count, file::shortest_number(axis.low),
      file::shortest_number(axis.high), kPercent * (axis.value(1) / axis.value(0) - 1.0),
      plan.tolerance);
  const DeviceSettings& device = plan.scene.x().device;
  if (!device.chai3d_stiffness_n_per_m || !device.chai3d_damping_n_s_per_m) return text;
  return text + fmt::format("CHAI3D allows on this device: a wall of at most {} kN/m, {:g} N s/m\n",
                            kilonewtons_per_metre(device.chai3d_stiffness_n_per_m),
                            *device.chai3d_damping_n_s_per_m);
}

std::string study_marks(const std::vector<ContactMetrics>& rows) {
  const auto any = [&](auto holds) { return std::ranges::any_of(rows, holds); };
  std::string text;
  if (any([](const ContactMetrics& r) { return r.limits.changes > 1; })) {
    text += kManyChangesNote;
  }
  if (any([](const ContactMetrics& r) { return rises(r, RiseKind::kOneTick); })) {
    text +=
        "* one jump in one tick: depends on the position of the wall between two encoder counts\n";
  }
  if (any([](const ContactMetrics& r) { return rises(r, RiseKind::kToTheLimit); })) {
    text += "+ limited by the force limit\n";
  }
  return text;
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

Json row_object(const ContactMetrics& row) {
  Json object{{"algorithm", row.summary.algorithm}};
  object["stiffest_n_per_m"] = json_number(of_stiffest(row, &Summary::displayed_stiffness_n_per_m));
  object["stiffest_tail_force_std_n"] = json_number(of_stiffest(row, &Summary::tail_force_std_n));
  add_limits(row.limits, object);
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
  objects.reserve(rows.size());
  for (const ContactMetrics& row : rows) objects.push_back(row_object(row));
  return objects;
}

}  // namespace

Sheet study_sheet(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  Sheet sheet = sheet_of(kStudyColumns, rows);
  sheet.heading = study_heading(plan, rows);
  sheet.marks = study_marks(rows);
  return sheet;
}

std::string study_json(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  return study_json_text(conditions_object(plan), row_objects(rows));
}

std::string study_csv(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  return study_csv_text(conditions_object(plan), row_objects(rows));
}

}  // namespace hapticwall::table
