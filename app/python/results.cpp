#include "app/python/results.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "app/file/text/text.h"

namespace hapticwall::python {
namespace {

template <typename Value>
nanobind::object python_value(const Value& value) {
  return nanobind::cast(value);
}
nanobind::object python_value(Verdict verdict) { return nanobind::cast(verdict_name(verdict)); }
nanobind::object python_value(double value) {
  return std::isfinite(value) ? nanobind::cast(value) : nanobind::none();
}
template <typename Value>
nanobind::object python_value(const std::optional<Value>& value) {
  return value ? python_value(*value) : nanobind::none();
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

double column_value(double value) { return value; }
double column_value(std::uint64_t value) { return static_cast<double>(value); }
double column_value(Verdict verdict) { return static_cast<double>(verdict); }
double column_value(const std::string& /*text*/) { return kNoNumber; }
template <typename Value>
double column_value(const std::optional<Value>& value) {
  return value ? column_value(*value) : kNoNumber;
}

bool is_number(const SummaryKey& key) {
  return key.of == KeyOf::kAll && !std::holds_alternative<std::string Summary::*>(key.member) &&
         !std::holds_alternative<std::optional<std::string> Summary::*>(key.member);
}

nanobind::object array_of(std::vector<double> values) {
  auto kept = std::make_unique<std::vector<double>>(std::move(values));
  const std::size_t size = kept->size();
  double* const data = kept->data();
  nanobind::capsule owner(kept.release(), [](void* vector) noexcept {
    delete static_cast<std::vector<double>*>(vector);
  });
  return nanobind::cast(Column(data, {size}, owner));
}

}  // namespace

RunSummary summaries_of(const AxesResult& result) {
  RunSummary run;
  for (const SimulationResult& axis : result.axes) run.push_back(axis.summary);
  return run;
}

void Rows::append(const Tick& tick) {
  const std::span<const Sample> axes = tick.in_use();
  samples.insert(samples.end(), axes.begin(), axes.end());
}

RowLayout layout_of(const file::CsvColumns& columns) {
  constexpr std::string_view kSecondAxis = "y_";
  RowLayout layout;
  layout.row_bytes = sizeof(Sample) * columns.axes;
  const Sample sample;
  const auto* const begin = reinterpret_cast<const std::byte*>(&sample);
  const std::string header = file::csv_header(columns);
  for (const std::string_view name : file::split(header, ',')) {
    const bool of_y = name.starts_with(kSecondAxis);
    const std::string_view of_axis = name.substr(of_y ? kSecondAxis.size() : 0);
    const auto add = [&](const auto& value) {
      const auto place = reinterpret_cast<const std::byte*>(&value) - begin;
      constexpr bool kReal = std::is_floating_point_v<std::decay_t<decltype(value)>>;
      layout.names.emplace_back(name);
      layout.formats.push_back((kReal ? "f" : "u") + std::to_string(sizeof(value)));
      layout.offsets.push_back((of_y ? sizeof(Sample) : 0) + static_cast<std::size_t>(place));
    };
    for_each_column(sample, [&](const SampleColumn& column, const auto& value) {
      if (column.name == of_axis) add(value);
    });
    for (const file::SignalColumn& signal : columns.signals) {
      if (of_axis.ends_with('.' + signal.name)) add(sample.signals.at(signal.place));
    }
  }
  return layout;
}

SummaryDict summary_dict(const RunSummary& run) {
  SummaryDict dict;
  for (std::size_t axis = 0; axis < run.size(); ++axis) {
    for (const SummaryKey& key : kSummaryKeys) {
      if (key.of != KeyOf::kAll || (axis > 0 && key.of_run)) continue;
      const bool none = key.name == "verdict" && !run[axis].has_verdict();
      const std::string name = (axis > 0 ? "y_" : "") + std::string(key.name);
      dict[name.c_str()] =
          none ? nanobind::none()
               : std::visit([&](auto member) { return python_value(run[axis].*member); },
                            key.member);
    }
  }
  return dict;
}

std::vector<NumberColumn> number_columns(std::size_t rows) {
  std::vector<NumberColumn> columns;
  for (const SummaryKey& key : kSummaryKeys) {
    if (is_number(key)) columns.emplace_back(key.name).values.reserve(rows);
  }
  return columns;
}

void append(std::vector<NumberColumn>& columns, std::span<const Summary> rows) {
  auto column = columns.begin();
  for (const SummaryKey& key : kSummaryKeys) {
    if (!is_number(key)) continue;
    for (const Summary& row : rows) {
      column->values.push_back(
          std::visit([&](auto member) { return column_value(row.*member); }, key.member));
    }
    ++column;
  }
}

SummaryColumns python_columns(std::vector<NumberColumn> columns) {
  SummaryColumns dict;
  for (NumberColumn& column : columns)
    dict[std::string(column.name).c_str()] = array_of(std::move(column.values));
  return dict;
}

}  // namespace hapticwall::python
