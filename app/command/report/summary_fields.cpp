#include "app/command/report/summary_fields.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/file/text/text.h"
#include "app/table/json_report.h"

namespace hapticwall::command {
namespace {

SummaryValue value_of(const std::string& text) { return text; }
SummaryValue value_of(Verdict verdict) { return std::string(verdict_name(verdict)); }
SummaryValue value_of(std::uint64_t count) { return count; }
SummaryValue value_of(double number) {
  if (!std::isfinite(number)) return std::monostate{};
  return number;
}
template <typename Value>
SummaryValue value_of(const std::optional<Value>& value) {
  if (!value) return std::monostate{};
  return value_of(*value);
}

SummaryValue value_of(const Summary& summary, const SummaryKey& key) {
  const bool is_verdict = std::holds_alternative<Verdict Summary::*>(key.member);
  if (is_verdict && !summary.has_verdict()) return std::monostate{};
  return std::visit([&](auto member) { return value_of(summary.*member); }, key.member);
}

table::Json json_object(const RunSummary& run) {
  table::Json object = table::Json::object();
  for (const SummaryField& field : summary_fields(run)) {
    table::Json& member = object[field.key];
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

}  // namespace

std::vector<SummaryField> summary_fields(const RunSummary& run) {
  std::vector<SummaryField> fields;
  for (std::size_t axis = 0; axis < run.size(); ++axis) {
    for (const SummaryKey& key : kSummaryKeys) {
      if ((axis > 0 && key.of_run) || !has_keys(run.front(), key.of)) continue;
      fields.push_back(
          {std::string(axis > 0 ? "y_" : "").append(key.name), value_of(run[axis], key)});
    }
  }
  return fields;
}

std::vector<SummaryField> all_summary_fields(std::size_t axes) {
  RunSummary session(axes);
  session.front().missed_ticks = 0;
  session.front().searched_hands = 0;
  for (Summary& axis : session) {
    axis.tail_peak_to_peak_m = 0.0;  // gives the axis a verdict
    axis.verdict_note = axis.disarm_reason = "";
  }
  return summary_fields(session);
}

std::string unknown_key(std::string_view key) {
  const std::vector<SummaryField> known = all_summary_fields();
  const auto keys = file::names_of(known, &SummaryField::key);
  const std::string hint = file::suggestion(key, keys);
  if (!hint.empty()) return fmt::format("the summary has no key {}{}", file::in_quotes(key), hint);
  const std::vector<SummaryField> of_x = all_summary_fields(1);
  return fmt::format("the summary has no key {}; known: {}; of a second axis: y_KEY",
                     file::in_quotes(key), file::joined(file::names_of(of_x, &SummaryField::key)));
}

std::string value_text(const SummaryValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<std::uint64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* real = std::get_if<double>(&value)) return file::shortest_number(*real);
  return "null";
}

std::string summary_json(const RunSummary& run) { return table::json_text(json_object(run)); }

std::string summaries_json(const std::vector<RunSummary>& runs) {
  table::Json array = table::Json::array();
  for (const RunSummary& run : runs) array.push_back(json_object(run));
  return table::json_text(array);
}

std::string summaries_csv(const std::vector<RunSummary>& runs) {
  std::vector<table::Json> objects;
  objects.reserve(runs.size());
  for (const RunSummary& run : runs) objects.push_back(json_object(run));
  return table::csv_text(objects);
}

}  // namespace hapticwall::command
