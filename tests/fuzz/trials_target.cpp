// A trial list, and a line of answers: any text.
#include <set>
#include <string>

#include "app/file/trials/answers_file.h"
#include "app/file/trials/trial_list.h"
#include "app/file/trials/trial_message.h"
#include "core/text.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

std::string written(const file::TrialList& list) {
  std::string text = "trial,block,kind,a,b,question,correct";
  for (const std::string& name : list.extras) text += "," + csv_field(name);
  text += '\n';
  for (const file::TrialSpec& trial : list.trials) {
    text += std::to_string(trial.number);
    for (const std::string& field : {trial.block, std::string(file::kind_name(trial.kind)),
                                     trial.slots[0], trial.slots[1], trial.question,
                                     std::string(!trial.correct                     ? ""
                                                 : *trial.correct == file::Slot::kA ? "a"
                                                                                    : "b")})
      text += "," + csv_field(field);
    for (const std::string& field : trial.extras) text += "," + csv_field(field);
    text += '\n';
  }
  return text;
}

void check_answer(std::string_view line) {
  const auto answer = file::parse_answer(line);
  require(!answer || file::answer_line(*answer) == std::string(line) + '\n',
          "an answer that was read is written the same");
  const auto columns = file::parse_answers_header(line);
  require(!columns || file::answers_header(*columns) == std::string(line) + '\n',
          "a line of columns that was read is written the same");
}

// A line from the program that gives trials.
void check_message(std::string_view line) {
  const auto message = file::parse_trial_message(line);
  if (!message || !std::holds_alternative<file::TrialFields>(*message)) return;
  const auto& fields = std::get<file::TrialFields>(*message);
  static_cast<void>(file::read_trial(fields, file::extra_columns_of(fields)));
}

Outcome fuzz_one(Bytes input) {
  const std::string origin = "fuzz.csv";
  check_answer(text_of(input));
  check_message(text_of(input));
  const auto list = file::parse_trial_list(text_of(input), origin);
  if (!list) {
    require_one_clean_line(list.error(), origin);
    return Outcome::kRefused;
  }
  std::set<std::uint64_t> numbers;
  for (const file::TrialSpec& trial : list->trials) {
    require(numbers.insert(trial.number).second, "a number stands once");
    for (const std::string& text : file::slot_overrides(trial.slots[0]))
      require(!text.empty() && text.find(';') == std::string::npos, "an override is one text");
  }
  const auto again = file::parse_trial_list(written(*list), "written.csv");
  require(again.ok() && written(*again) == written(*list), "a list that was written reads back");
  return Outcome::kTaken;
}

const Registered kRegistered({"trials", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
