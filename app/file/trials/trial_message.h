// Lines of JSON between the window and the program that gives its trials (docs/experiments.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/file/trials/answer.h"
#include "app/file/trials/trial_list.h"
#include "core/result.h"

namespace hapticwall::file {

// Bytes of a line, without its end.
inline constexpr std::size_t kMaxMessageBytes = std::size_t{1} << 14U;

struct EndOfTrials {};
// The choice of a simulated observer.
struct Choice {
  bool first = true;  // false: the second presentation
};
using TrialMessage = std::variant<TrialFields, EndOfTrials, Choice>;

// {"trial": {COLUMN: VALUE, ...}}, {"end": true} or {"choose": 1 or 2}. A value is a text, a
// number, a truth value or null. Fails (exit status 2) for every other text; never throws.
[[nodiscard]] Result<TrialMessage> parse_trial_message(std::string_view line);

// Lines to that program, each with its end.
[[nodiscard]] std::string hello_line(const Answer& identity, std::size_t answers);
[[nodiscard]] std::string answer_message(const Answer& answer, const AnswerColumns& columns);
// Asks for the trial with this number.
[[nodiscard]] std::string next_line(std::uint64_t number);
[[nodiscard]] std::string error_line(std::string_view what);
[[nodiscard]] std::string end_line(std::string_view why);
// Two presentations, as a simulated observer meets them.
struct FeltTrial {
  std::uint64_t number = 0;
  Slot first = Slot::kA;
  std::array<ExposureRow, 2> exposures{};  // of the first and of the second presentation
  std::vector<std::string> keys;
  std::vector<std::string> values;  // of the keys: A and B by turns
};
// Asks a simulated observer to choose.
[[nodiscard]] std::string felt_line(const FeltTrial& felt);

}  // namespace hapticwall::file
