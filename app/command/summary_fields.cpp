#include "app/command/summary_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/command/json_report.h"
#include "app/file/text.h"

namespace hapticwall::command {
namespace {

SummaryValue number(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return std::monostate{};
  return *value;
}

SummaryValue count(std::optional<std::uint64_t> value) {
  if (!value) return std::monostate{};
  return *value;
}

Json json_object(const Summary& summary) {
  Json object = Json::object();
  for (const SummaryField& field : summary_fields(summary)) {
    Json& member = object[field.key];
    std::visit(
        [&](const auto& value) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) {
            member = value;
          }
        },
        field.value);
  }
  return object;
}

constexpr std::string_view kSecondAxisPrefix = "y_";

// Figures of a run, not of an axis.
bool is_shared(std::string_view key) {
  static constexpr std::array<std::string_view, 4> kShared{
      "scene", "algorithm", "simulated_seconds_per_second", "ns_per_tick"};
  return std::find(kShared.begin(), kShared.end(), key) != kShared.end();
}

std::vector<SummaryField> axis_fields(const Summary& s) {
  return {{"scene", s.scene},
          {"algorithm", s.algorithm},
          {"verdict", std::string(verdict_name(s.verdict))},
          {"duration_s", number(s.duration_s)},
          {"ticks", s.ticks},
          {"simulated_seconds_per_second", number(s.simulated_seconds_per_second)},
          {"ns_per_tick", number(s.ns_per_tick)},
          {"tail_peak_to_peak_m", number(s.tail_peak_to_peak_m)},
          {"tail_force_mean_n", number(s.tail_force_mean_n)},
          {"tail_force_std_n", number(s.tail_force_std_n)},
          {"displayed_stiffness_n_per_m", number(s.displayed_stiffness_n_per_m)},
          {"max_penetration_m", number(s.max_penetration_m)},
          {"peak_force_n", number(s.peak_force_n)},
          {"saturated_ticks", s.saturated_ticks},
          {"contacts", s.contacts},
          {"energy_cv_j", number(s.energy_cv_j)},
          {"energy_hold_j", number(s.energy_hold_j)},
          {"energy_scv_j", number(s.energy_scv_j)},
          {"energy_budget_j", number(s.energy_budget_j)},
          {"min_energy_cv_j", number(s.min_energy_cv_j)},
          {"min_energy_scv_j", number(s.min_energy_scv_j)},
          {"true_actuator_work_j", number(s.true_actuator_work_j)},
          {"true_dissipation_j", number(s.true_dissipation_j)},
          {"true_hand_work_j", number(s.true_hand_work_j)},
          {"kinetic_j", number(s.kinetic_j)},
          {"energy_balance_error_j", number(s.energy_balance_error_j)},
          {"passivity_margin_j", number(s.passivity_margin_j)},
          {"diverged_at_tick", count(s.diverged_at_tick)}};
}

}  // namespace

std::vector<SummaryField> summary_fields(const Summary& summary) {
  std::vector<SummaryField> fields = axis_fields(summary);
  for (const Summary& y : summary.y) {
    for (SummaryField& field : axis_fields(y)) {
      if (is_shared(field.key)) continue;
      fields.push_back({std::string(kSecondAxisPrefix) + field.key, std::move(field.value)});
    }
  }
  return fields;
}

std::vector<SummaryField> all_summary_fields() {
  Summary corner;
  corner.y.emplace_back();
  return summary_fields(corner);
}

std::string unknown_key(std::string_view key) {
  const std::vector<SummaryField> known = all_summary_fields();
  std::vector<std::string_view> keys;
  keys.reserve(known.size());
  for (const SummaryField& one : known) keys.push_back(one.key);
  const std::string hint = file::suggestion(key, keys);
  return fmt::format("the summary has no key {}{}", file::in_quotes(key),
                     hint.empty() ? "; known: " + file::joined(keys) : hint);
}

std::string value_text(const SummaryValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<std::uint64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* real = std::get_if<double>(&value)) return file::number_text(*real);
  return "null";
}

std::string summary_json(const Summary& summary) { return json_text(json_object(summary)); }

std::string summaries_json(const std::vector<Summary>& summaries) {
  Json array = Json::array();
  for (const Summary& summary : summaries) array.push_back(json_object(summary));
  return json_text(array);
}

std::string summaries_csv(const std::vector<Summary>& summaries) {
  std::string text;
  for (const SummaryField& field : summary_fields(summaries.empty() ? Summary{} : summaries[0])) {
    text += fmt::format("{}{}", text.empty() ? "" : ",", field.key);
  }
  text += '\n';
  for (const Summary& summary : summaries) {
    std::string_view separator;
    for (const SummaryField& field : summary_fields(summary)) {
      const bool is_null = std::holds_alternative<std::monostate>(field.value);
      text += separator;
      if (!is_null) text += csv_field(value_text(field.value));
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

}  // namespace hapticwall::command
