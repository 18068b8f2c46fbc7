#include "app/table/accuracy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "app/file/text/text.h"
#include "app/table/json_report.h"
#include "core/units.h"

namespace hapticwall::table {
namespace {

constexpr std::string_view kWrongVerdictMark = " !";
constexpr std::string_view kReference = "exact integrator in extended precision";
constexpr std::string_view kReferenceNote =
    "the reference is the code of 'exact' in extended precision: the errors are those of steps "
    "and\n"
    "rounding, and an error of the common equations does not show (docs/accuracy.md)\n";

template <typename T>
Json value_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

std::string_view name_of(Integrator integrator) {
  return kIntegratorNames.at(static_cast<std::size_t>(integrator));
}

Json reference_object(const Summary& reference) {
  return {{"scene", reference.scene},
          {"algorithm", reference.algorithm},
          {"duration_s", json_number(reference.duration_s)},
          {"ticks", reference.ticks},
          {"reference_verdict", verdict_name(reference.verdict)},
          {"reference_tail_peak_to_peak_m", json_number(reference.tail_peak_to_peak_m)},
          {"reference_diverged_at_tick", value_or_null(reference.diverged_at_tick)}};
}

Json row_object(const AccuracyRow& row) {
  return {{"integrator", name_of(row.integrator)},
          {"substeps", value_or_null(row.substeps)},
          {"ns_per_tick", json_number(row.ns_per_tick)},
          {"ratio_to_exact", json_number(row.ratio_to_exact)},
          {"set_up_ns", json_number(row.set_up_ns)},
          {"max_position_error_m", json_number(row.max_position_error_m)},
          {"energy_balance_error_j", json_number(row.energy_balance_error_j)},
          {"energy_balance_relative", json_number(row.energy_balance_relative)},
          {"tail_peak_to_peak_m", json_number(row.tail_peak_to_peak_m)},
          {"tail_peak_to_peak_relative_error", json_number(row.tail_peak_to_peak_relative_error)},
          {"verdict", verdict_name(row.verdict)},
          {"verdict_agrees", row.verdict_agrees},
          {"diverged_at_tick", value_or_null(row.diverged_at_tick)}};
}

std::string scientific(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return "-";
  return fmt::format("{:.1e}", *value);
}

std::string verdict_text(const AccuracyRow& row) {
  std::string text(verdict_name(row.verdict));
  if (row.diverged_at_tick) text += fmt::format(" at tick {}", *row.diverged_at_tick);
  if (!row.verdict_agrees) text += kWrongVerdictMark;
  return text;
}

constexpr std::array<Column<AccuracyRow>, 11> kAccuracyColumns{
    {{"integrator", "", [](const AccuracyRow& r) { return std::string(name_of(r.integrator)); },
      Align::kLeft},
     {"substeps", "",
      [](const AccuracyRow& r) { return r.substeps ? fmt::format("{}", *r.substeps) : "-"; }},
     {"a tick", "ns", [](const AccuracyRow& r) { return fixed(r.ns_per_tick, 1.0, 1); }},
     {"to exact", "x", [](const AccuracyRow& r) { return fixed(r.ratio_to_exact, 1.0, 2); }},
     {"set-up", "us",
      [](const AccuracyRow& r) { return fixed(r.set_up_ns, 1.0 / kNanosecondsPerMicrosecond, 0); }},
     {"position error", "m",
      [](const AccuracyRow& r) { return scientific(r.max_position_error_m); }},
     {"balance error", "J",
      [](const AccuracyRow& r) { return scientific(r.energy_balance_error_j); }},
     {"to turnover", "",
      [](const AccuracyRow& r) { return scientific(r.energy_balance_relative); }},
     {"tail p-p", "mm",
      [](const AccuracyRow& r) { return fixed(r.tail_peak_to_peak_m, kMillimetresPerMetre, 4); }},
     {"its error", "%",
      [](const AccuracyRow& r) { return fixed(r.tail_peak_to_peak_relative_error, kPercent, 2); }},
     {"verdict", "", verdict_text, Align::kLeft}}};

std::vector<Json> row_objects(const AccuracyStudy& study) {
  std::vector<Json> rows;
  for (const AccuracyRow& row : study.rows) rows.push_back(row_object(row));
  return rows;
}

std::string accuracy_heading(const Summary& reference) {
  std::string text =
      fmt::format("{} under {}, {} ticks\nreference: {}", reference.scene, reference.algorithm,
                  reference.ticks, verdict_name(reference.verdict));
  if (reference.diverged_at_tick) {
    return text + fmt::format(" at tick {}; errors of position and tail do not apply\n",
                              *reference.diverged_at_tick);
  }
  return text + fmt::format(", {} mm peak to peak in the last second (tail)\n",
                            fixed(reference.tail_peak_to_peak_m, kMillimetresPerMetre, 4));
}

}  // namespace

Sheet accuracy_sheet(const AccuracyStudy& study) {
  Sheet sheet = sheet_of(kAccuracyColumns, study.rows);
  sheet.heading = accuracy_heading(study.reference);
  sheet.marks = kReferenceNote;
  if (!std::ranges::all_of(study.rows, &AccuracyRow::verdict_agrees)) {
    sheet.marks += "! the verdict differs from the reference's\n";
  }
  return sheet;
}

std::string accuracy_json(const AccuracyStudy& study) {
  Json object = reference_object(study.reference);
  object["reference"] = kReference;
  return study_json_text(std::move(object), row_objects(study));
}

std::string accuracy_csv(const AccuracyStudy& study) {
  return study_csv_text(reference_object(study.reference), row_objects(study));
}

}  // namespace hapticwall::table
