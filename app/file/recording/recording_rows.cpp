#include "app/file/recording_rows.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

#include "app/file/text.h"
#include "core/usage_error.h"

namespace hapticwall::file {
namespace {

constexpr std::array kAxisNumbers{&Sample::position_m,    &Sample::velocity_m_per_s,
                                  &Sample::penetration_m, &Sample::wall_force_n,
                                  &Sample::force_n,       &Sample::stiffness_n_per_m,
                                  &Sample::energy_cv_j,   &Sample::energy_hold_j,
                                  &Sample::energy_scv_j,  &Sample::energy_budget_j};
constexpr std::array kTruthNumbers{&PlantTruth::position_m,      &PlantTruth::velocity_m_per_s,
                                   &PlantTruth::hand_path_m,     &PlantTruth::hand_force_n,
                                   &PlantTruth::actuator_work_j, &PlantTruth::dissipation_j,
                                   &PlantTruth::hand_work_j,     &PlantTruth::kinetic_j};

// Reads fields from left to right; once one is wrong, it is false for good.
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
  // The last field has been taken, and no comma stands after it.
  [[nodiscard]] bool at_end() const { return ended_; }

 private:
  const char* at_;
  const char* end_;
  bool ended_ = false;
};

bool take_axis(Fields& fields, MoreColumns columns, Sample& sample) {
  for (const auto number : kAxisNumbers) {
    if (!fields.take(sample.*number)) return false;
  }
  if (!fields.take(sample.flags)) return false;
  if (!of_simulator(columns)) {
    return fields.take(sample.device_time_s) && fields.take(sample.read_age_s);
  }
  for (const auto number : kTruthNumbers) {
    if (!fields.take(sample.truth.*number)) return false;
  }
  return true;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <typename Number>
bool is_number(std::string_view field) {
  Number value{};
  const char* end = field.data() + field.size();
  const auto [rest, code] = std::from_chars(field.data(), end, value);
  return code == std::errc{} && rest == end && std::isfinite(static_cast<double>(value));
}

// Only for a row that is wrong: slow, and says why.
std::string problem_of(std::string_view line, MoreColumns columns) {
  const std::string header = csv_header(columns);
  const std::vector<std::string_view> names = split(header);
  const std::vector<std::string_view> fields = split(line);
  for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) {
    const std::string_view name = names[i];
    if (name == "tick" && !is_number<std::uint64_t>(fields[i])) {
      return fmt::format("tick: {} is no whole number", in_quotes(fields[i]));
    }
    if (name.ends_with("flags") && !is_number<std::uint32_t>(fields[i])) {
      return fmt::format("{}: {} is no whole number", name, in_quotes(fields[i]));
    }
    if (!is_number<double>(fields[i])) {
      return fmt::format("{}: {} is no finite number", name, in_quotes(fields[i]));
    }
  }
  return fmt::format("{} columns; it should be {}", fields.size(), names.size());
}

}  // namespace

Result<MoreColumns> parse_csv_header(std::string_view line) {
  for (const bool simulated : {true, false}) {
    for (const bool second_axis : {false, true}) {
      const MoreColumns columns = more_columns(simulated, second_axis);
      if (line == csv_header(columns)) return columns;
    }
  }
  const MoreColumns meant = more_columns(line.find("device_time_s") == std::string_view::npos,
                                         line.find(",y_") != std::string_view::npos);
  const std::string header = csv_header(meant);
  const std::vector<std::string_view> wanted = split(header);
  const std::vector<std::string_view> found = split(line.substr(0, kLongestCsvLine));
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

std::optional<std::string> parse_csv_row(std::string_view line, MoreColumns columns, Sample& sample,
                                         Sample* y) {
  sample = Sample{};
  Sample second;
  Fields fields(line);
  bool whole =
      fields.take(sample.tick) && fields.take(sample.time_s) && take_axis(fields, columns, sample);
  second.tick = sample.tick;
  second.time_s = sample.time_s;
  if (whole && has_second_axis(columns)) whole = take_axis(fields, columns, second);
  if (y != nullptr) *y = second;
  if (whole && fields.at_end()) return std::nullopt;
  return problem_of(line, columns);
}

}  // namespace hapticwall::file
