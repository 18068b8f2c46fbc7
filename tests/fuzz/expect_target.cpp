// --expect: any text that an argument can hold.
#include <cmath>
#include <string>
#include <variant>

#include "app/command/report/expectation.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

Outcome fuzz_one(Bytes input) {
  const std::string text(text_of(input).substr(0, text_of(input).find('\0')));
  const Result<command::Expectation> expectation = command::parse_expectation(text);
  if (!expectation) {
    require_one_clean_line(expectation.error(), "--expect ");
    return Outcome::kRefused;
  }
  require(expectation->text == text, "an expectation remembers how it was written");
  const double* number = std::get_if<double>(&expectation->value);
  require(number == nullptr || std::isfinite(*number), "an expectation's number is finite");
  const std::optional<std::string> found = command::unmet(*expectation, RunSummary(1));
  require(!found || is_clean(*found), "what was found is one clean line");
  return Outcome::kTaken;
}

const Registered kRegistered({"expect", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
