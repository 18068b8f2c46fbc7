#include "app/command/report/expectation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "app/command/report/summary_fields.h"
#include "app/command/report/terminal.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::command {
namespace {

constexpr int kExpectationFailed = 1;

struct Operator {
  std::string_view sign;
  bool (*holds)(double found, double value);
};
constexpr std::array<Operator, 5> kOperators{
    {{"<", [](double found, double value) { return found < value; }},
     {"<=", [](double found, double value) { return found <= value; }},
     {"=", [](double found, double value) { return found == value; }},
     {">=", [](double found, double value) { return found >= value; }},
     {">", [](double found, double value) { return found > value; }}}};
constexpr std::string_view kOperatorsText = "one of < <= = >= >";

Error problem(const std::string& text, std::string_view message) {
  return usage_error(fmt::format("--expect {}: {}", file::in_quotes(text), message));
}

// nullptr if there is no such operator.
const Operator* find_operator(std::string_view sign) {
  const auto* found = std::ranges::find(kOperators, sign, &Operator::sign);
  return found == kOperators.end() ? nullptr : found;
}

std::optional<SummaryField> field_of(std::string_view key,
                                     const std::vector<SummaryField>& fields) {
  for (const SummaryField& field : fields) {
    if (field.key == key) return field;
  }
  return std::nullopt;
}

std::optional<Error> check_word(const Expectation& expectation, std::string_view word) {
  if (expectation.sign != "=") {
    return problem(expectation.text,
                   fmt::format("{} is a word; it is compared with =", expectation.key));
  }
  if (!expectation.key.ends_with("verdict")) return std::nullopt;
  if (find_verdict(word)) return std::nullopt;
  return problem(expectation.text, fmt::format("{} is no verdict; verdicts: {}",
                                               file::in_quotes(word), file::joined(kVerdictNames)));
}

bool holds(const Expectation& expectation, const SummaryValue& found) {
  if (const auto* word = std::get_if<std::string>(&found)) {
    return *word == std::get<std::string>(expectation.value);
  }
  if (std::holds_alternative<std::monostate>(found)) return false;
  const auto* integer = std::get_if<std::uint64_t>(&found);
  const double number =
      integer != nullptr ? static_cast<double>(*integer) : std::get<double>(found);
  return find_operator(expectation.sign)->holds(number, std::get<double>(expectation.value));
}

}  // namespace

Result<Expectation> parse_expectation(const std::string& text) {
  const std::size_t sign_at = text.find_first_of("<=>");
  if (sign_at == std::string::npos) {
    return problem(text, fmt::format("it takes KEY OPERATOR VALUE with {}", kOperatorsText));
  }
  const std::size_t sign_end = std::min(text.find_first_not_of("<=>", sign_at), text.size());
  const std::string_view sign = std::string_view(text).substr(sign_at, sign_end - sign_at);
  const std::string_view value = file::trimmed(std::string_view(text).substr(sign_end));
  Expectation expectation;
  expectation.text = text;
  expectation.key = std::string(file::trimmed(std::string_view(text).substr(0, sign_at)));
  const std::optional<SummaryField> field = field_of(expectation.key, all_summary_fields());
  if (!field) return problem(text, unknown_key(expectation.key));
  if (find_operator(sign) == nullptr) {
    return problem(text, fmt::format("{} is no operator; it takes {}", sign, kOperatorsText));
  }
  expectation.sign = sign;
  if (std::holds_alternative<std::string>(field->value)) {
    // An old name of an algorithm means the present one.
    const auto algorithm = expectation.key == "algorithm" ? find_algorithm(value) : std::nullopt;
    expectation.value = std::string(algorithm ? algorithms()[*algorithm].name : value);
    if (const std::optional<Error> error = check_word(expectation, value)) return *error;
    return expectation;
  }
  const std::optional<double> number = file::parsed<double>(value);
  if (!number) return problem(text, fmt::format("{} is not a number", file::in_quotes(value)));
  expectation.value = *number;
  return expectation;
}

Result<std::vector<Expectation>> parse_expectations(const std::vector<std::string>& texts) {
  std::vector<Expectation> expectations;
  for (const std::string& text : texts) {
    const Result<Expectation> expectation = parse_expectation(text);
    if (!expectation) return expectation.error();
    expectations.push_back(*expectation);
  }
  return expectations;
}

std::optional<std::string> unmet(const Expectation& expectation, const RunSummary& run) {
  const std::optional<SummaryField> field = field_of(expectation.key, summary_fields(run));
  if (field && holds(expectation, field->value)) return std::nullopt;
  const std::string found = field ? value_text(field->value) : "null";
  return fmt::format("expected {}, found {} = {} ({} under {})", file::shown(expectation.text),
                     expectation.key, found, file::shown(run.front().scene), run.front().algorithm);
}

int judge(const std::vector<Expectation>& expectations, std::span<const RunSummary> runs) {
  int status = 0;
  for (const RunSummary& run : runs) {
    for (const Expectation& expectation : expectations) {
      if (const std::optional<std::string> line = unmet(expectation, run)) {
        tell(*line);
        status = kExpectationFailed;
      }
    }
  }
  return status;
}

}  // namespace hapticwall::command
