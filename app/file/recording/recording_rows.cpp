#include "app/file/recording/recording_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

#include "app/file/text/text.h"
#include "core/environment/environment.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kSecondAxisPrefix = "y_";
constexpr std::string_view kSignalPrefix = "signal.";

std::string_view axis_prefix(std::size_t axis) { return axis > 0 ? kSecondAxisPrefix : ""; }

void append_value(std::string& text, double value) { append_number(text, value); }
void append_value(std::string& text, std::unsigned_integral auto value) {
  std::array<char, std::numeric_limits<std::uint64_t>::digits10 + 1> digits{};
  text.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

// Lambdas, so that each use is compiled for its columns alone.
constexpr auto kOfTick = [](const SampleColumn& column, const CsvColumns& /*columns*/) {
  return column.group == ColumnGroup::kTick;
};
constexpr auto kOfAxis = [](const SampleColumn& column, const CsvColumns& columns) {
  return column.group == ColumnGroup::kAxis || column.group == columns.source ||
         (column.group == ColumnGroup::kApplied && columns.applied);
};

// Reads fields from left to right.
class Fields {
 public:
  explicit Fields(std::string_view line) : at_(line.data()), end_(line.data() + line.size()) {}

  template <typename Number>
  bool take(Number& value) {
    const auto [rest, code] = std::from_chars(at_, end_, value);
    if (code != std::errc{}) return false;
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) return false;
    }
    at_ = rest;
    if (at_ == end_) {
      ended_ = true;
      return true;
    }
    if (*at_ != ',') return false;
    ++at_;
    return true;
  }
  // NaN for an empty field.
  bool take_signal(double& value) {
    if (at_ != end_ && *at_ != ',') return take(value);
    value = std::numeric_limits<double>::quiet_NaN();
    ended_ = at_ == end_;
    if (!ended_) ++at_;
    return true;
  }
  // True after the last field, if no comma follows it.
  [[nodiscard]] bool at_end() const { return ended_; }

 private:
  const char* at_;
  const char* end_;
  bool ended_ = false;
};

template <typename Wanted>
bool take_columns(Fields& fields, const CsvColumns& columns, Wanted&& wanted, Sample& sample) {
  return all_columns(sample, [&](const SampleColumn& column, auto& value) {
    return !wanted(column, columns) || fields.take(value);
  });
}

bool take_signals(Fields& fields, const CsvColumns& columns, Sample& sample) {
  return std::ranges::all_of(columns.signals, [&](const SignalColumn& column) {
    return !fields.at_end() && fields.take_signal(sample.signals[column.place]);
  });
}

template <typename Wanted>
void append_columns(std::string& text, const CsvColumns& columns, Wanted&& wanted,
                    const Sample& sample) {
  for_each_column(sample, [&](const SampleColumn& column, const auto& value) {
    if (!wanted(column, columns)) return;
    append_value(text, value);
    text += ',';
  });
}

void append_signals(std::string& text, const CsvColumns& columns, const Sample& sample) {
  for (const SignalColumn& column : columns.signals) {
    const double value = sample.signals[column.place];
    if (!std::isnan(value)) append_value(text, value);
    text += ',';
  }
}

void append_signal_members(std::string& text, const CsvColumns& columns, std::string_view prefix,
                           const Sample& sample) {
  for (const SignalColumn& column : columns.signals) {
    const double value = sample.signals[column.place];
    text.append(1, '"').append(prefix).append(kSignalPrefix).append(column.name).append("\":");
    std::isnan(value) ? text.append("null") : (append_value(text, value), text);
    text += ',';
  }
}

// The names of the signals of axis x that a header line has.
Result<std::vector<SignalColumn>> signals_in(std::string_view header) {
  std::vector<SignalColumn> found;
  std::size_t free = algorithm_signals().size();
  for (std::string_view name : split(header, ',')) {
    if (!name.starts_with(kSignalPrefix)) continue;
    name.remove_prefix(kSignalPrefix.size());
    const std::size_t place = find_algorithm_signal(name).value_or(free);
    if (place == free) ++free;
    if (place >= kMaxSignals)
      return usage_error(fmt::format("more than {} signals of algorithms", kMaxSignals));
    if (name.empty() || std::ranges::find(found, name, &SignalColumn::name) != found.end())
      return usage_error(fmt::format("the signal {} has no name of its own", in_quotes(name)));
    found.push_back({std::string(name), place});
  }
  return found;
}

template <typename Wanted>
void append_members(std::string& text, const CsvColumns& columns, Wanted&& wanted,
                    std::string_view prefix, const Sample& sample) {
  for_each_column(sample, [&](const SampleColumn& column, const auto& value) {
    if (!wanted(column, columns)) return;
    text.append(1, '"').append(prefix).append(column.name).append("\":");
    append_value(text, value);
    text += ',';
  });
}

// The reason why a row is wrong. Slow.
std::string problem_of(std::string_view line, const CsvColumns& columns) {
  const std::string header = csv_header(columns);
  const std::vector<std::string_view> names = split(header, ',');
  const std::vector<std::string_view> fields = split(line, ',');
  for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) {
    const std::string_view name = names[i];
    if (name == "tick" && !parsed<std::uint64_t>(fields[i])) {
      return fmt::format("tick: {} is no whole number", in_quotes(fields[i]));
    }
    if (name.ends_with("flags") && !parsed<std::uint32_t>(fields[i])) {
      return fmt::format("{}: {} is no whole number", name, in_quotes(fields[i]));
    }
    const bool may_be_empty = name.find(kSignalPrefix) != std::string_view::npos;
    if (!parsed<double>(fields[i]) && !(may_be_empty && fields[i].empty())) {
      return fmt::format("{}: {} is no finite number", name, in_quotes(fields[i]));
    }
  }
  return fmt::format("{} columns; it should be {}", fields.size(), names.size());
}

}  // namespace

std::string csv_header(const CsvColumns& columns) {
  std::string header;
  const auto add = [&](auto&& wanted, std::string_view prefix) {
    for (const SampleColumn& column : kSampleColumns) {
      if (!wanted(column, columns)) continue;
      if (!header.empty()) header += ',';
      header.append(prefix).append(column.name);
    }
  };
  add(kOfTick, "");
  for (std::size_t axis = 0; axis < columns.axes; ++axis) {
    add(kOfAxis, axis_prefix(axis));
    for (const SignalColumn& column : columns.signals)
      header.append(1, ',').append(axis_prefix(axis)).append(kSignalPrefix).append(column.name);
  }
  return header;
}

SignalNames signal_names(const CsvColumns& columns) {
  SignalNames names;
  for (const SignalColumn& column : columns.signals) names.at(column.place) = column.name;
  return names;
}

namespace {

void add_signals(std::span<const SignalDescription> signals, std::vector<SignalColumn>& columns) {
  for (const SignalDescription& signal : signals) {
    const SignalColumn column{std::string(signal.name), *find_algorithm_signal(signal.name)};
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
  }
}

}  // namespace

std::vector<SignalColumn> signal_columns(std::span<const std::size_t> indices) {
  std::vector<SignalColumn> columns;
  for (const std::size_t index : indices) add_signals(algorithms()[index].signals, columns);
  return columns;
}

std::vector<SignalColumn> all_signal_columns() {
  std::vector<std::size_t> indices(algorithms().size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  std::vector<SignalColumn> columns = signal_columns(indices);
  add_signals(environment_signals(), columns);
  return columns;
}

std::vector<SignalColumn> signal_columns(const Scene& scene,
                                         std::span<const ScheduledChange> changes) {
  std::vector<std::size_t> indices;
  const auto add = [&](const AlgorithmSettings& algorithm) {
    indices.push_back(algorithm.index);
    if (has_follower(algorithm)) indices.push_back(follower_index());
  };
  add(scene.algorithm);
  for (const ScheduledChange& change : changes) add(change.scene.algorithm);
  std::vector<SignalColumn> columns = signal_columns(indices);
  const auto add_environment = [&](const EnvironmentSettings& environment) {
    add_signals(environments()[environment.index].description.signals, columns);
  };
  add_environment(scene.environment);
  for (const ScheduledChange& change : changes) add_environment(change.scene.environment);
  return columns;
}

Result<CsvColumns> parse_csv_header(std::string_view line) {
  Result<std::vector<SignalColumn>> signals = signals_in(line.substr(0, kMaxCsvLineBytes));
  if (!signals) return signals.error();
  for (const bool simulated : {true, false}) {
    for (std::size_t axes = 1; axes <= kMaxAxes; ++axes) {
      CsvColumns columns = csv_columns(simulated, axes);
      columns.signals = *signals;
      if (line == csv_header(columns)) return columns;
      columns.applied = false;
      if (line == csv_header(columns)) return columns;
    }
  }
  CsvColumns meant = csv_columns(line.find("device_time_s") == std::string_view::npos,
                                 line.find(",y_") == std::string_view::npos ? 1 : 2);
  meant.signals = std::move(*signals);
  const std::string header = csv_header(meant);
  const std::vector<std::string_view> wanted = split(header, ',');
  const std::vector<std::string_view> found = split(line.substr(0, kMaxCsvLineBytes), ',');
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (i >= found.size()) return usage_error(fmt::format("the column {} is missing", wanted[i]));
    if (found[i] == wanted[i]) continue;
    return usage_error(fmt::format("{}column {} is {}, it should be {}",
                                   i == 0 ? "not a recording: " : "", i + 1, in_quotes(found[i]),
                                   wanted[i]));
  }
  return usage_error(fmt::format("column {}, {}, is one too many", wanted.size() + 1,
                                 in_quotes(found[wanted.size()])));
}

void append_csv_row(std::string& text, const Tick& tick, const CsvColumns& columns) {
  append_columns(text, columns, kOfTick, tick.x());
  for (const Sample& sample : tick.in_use()) {
    append_columns(text, columns, kOfAxis, sample);
    append_signals(text, columns, sample);
  }
  text.back() = '\n';
}

void append_json_object(std::string& text, const Tick& tick, const CsvColumns& columns,
                        std::uint64_t lost) {
  text += '{';
  append_members(text, columns, kOfTick, "", tick.x());
  for (std::size_t axis = 0; axis < tick.count; ++axis) {
    append_members(text, columns, kOfAxis, axis_prefix(axis), tick.axes[axis]);
    append_signal_members(text, columns, axis_prefix(axis), tick.axes[axis]);
  }
  text += "\"lost\":";
  append_value(text, lost);
  text += "}\n";
}

std::optional<std::string> parse_csv_row(std::string_view line, const CsvColumns& columns,
                                         Tick& tick) {
  tick = Tick{};
  tick.count = columns.axes;
  Fields fields(line);
  Sample& x = tick.axes.front();
  bool whole = take_columns(fields, columns, kOfTick, x);
  for (Sample& sample : tick.in_use()) {
    sample.tick = x.tick;
    sample.time_s = x.time_s;
    whole = whole && take_columns(fields, columns, kOfAxis, sample) &&
            take_signals(fields, columns, sample);
  }
  if (whole && fields.at_end()) return std::nullopt;
  return problem_of(line, columns);
}

}  // namespace hapticwall::file
