#include "app/session/trial_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "app/file/text/text.h"
#include "app/session/experiment.h"

namespace hapticwall::session {
namespace {

constexpr int kLinesAtATime = 16;  // bounds a frame of the window
constexpr std::size_t kMaxKeys = 32;

// The number of the next trial if its line has none: breaks do not count.
std::uint64_t next_number(const Experiment& experiment) {
  std::uint64_t number = 0;
  for (const file::TrialSpec& trial : experiment.trials) {
    if (trial.kind != file::TrialKind::kBreak) number = std::max(number, trial.number);
  }
  return number + 1;
}

Failure check_number(const Experiment& experiment, const file::TrialSpec& trial) {
  if (experiment.trials.size() >= file::kMaxTrials)
    return usage_error(fmt::format("more than {} trials", file::kMaxTrials));
  if (trial.number == 0) return usage_error("trial: no number is left after the largest");
  const bool taken = trial.kind != file::TrialKind::kBreak &&
                     std::ranges::any_of(experiment.trials, [&](const file::TrialSpec& other) {
                       return other.kind != file::TrialKind::kBreak && other.number == trial.number;
                     });
  if (taken) return usage_error(fmt::format("trial: {} was given before", trial.number));
  return std::nullopt;
}

// Every key that a trial sets has its columns.
Failure check_keys(const file::TrialSpec& trial, const file::AnswerColumns& columns) {
  for (const std::string& key : keys_of(std::array{trial})) {
    if (std::ranges::find(columns.keys, key) != columns.keys.end()) continue;
    return usage_error(fmt::format(
        "{}: the first trial sets no such key; name all keys in its a or b", file::shown(key)));
  }
  return std::nullopt;
}

}  // namespace

void TrialFeed::begin(Experiment& experiment) {
  const auto found = experiment.answers.found();
  pipe_->send(file::hello_line(experiment.answers.identity(), found.size()));
  for (const file::Answer& answer : found) {
    file::TrialSpec trial;
    trial.number = answer.trial;
    trial.block = answer.block;
    trial.kind = answer.kind;
    trial.slots = {answer.a, answer.b};
    trial.question = answer.question;
    trial.extras = answer.extras;
    experiment.trials.push_back(std::move(trial));
    experiment.scenes.push_back({loader_.base(), loader_.base()});
    pipe_->send(file::answer_message(answer, *experiment.answers.columns()));
  }
  ask(experiment);
}

void TrialFeed::answered(const Experiment& experiment, const file::Answer& answer) {
  pipe_->send(file::answer_message(experiment.answers.signed_answer(answer),
                                   *experiment.answers.columns()));
}

void TrialFeed::ask(const Experiment& experiment) {
  pipe_->send(file::next_line(next_number(experiment)));
}

void TrialFeed::end(std::string_view why) {
  if (!std::exchange(ended_, true)) pipe_->send(file::end_line(why));
}

FeedEvent TrialFeed::take(Experiment& experiment) {
  for (int i = 0; i < kLinesAtATime; ++i) {
    const std::optional<std::string> line = pipe_->take();
    if (!line) return pipe_->ended() ? FeedEvent::kLeft : FeedEvent::kNothing;
    const Result<FeedEvent> event = handle(experiment, *line);
    problem_ = event ? "" : event.error().message;
    if (event) return *event;
    pipe_->send(file::error_line(problem_));
  }
  return FeedEvent::kNothing;
}

Result<FeedEvent> TrialFeed::handle(Experiment& experiment, const std::string& line) {
  const Result<file::TrialMessage> message = file::parse_trial_message(line);
  if (!message) return message.error();
  if (std::holds_alternative<file::EndOfTrials>(*message)) return FeedEvent::kEnd;
  if (const auto* choice = std::get_if<file::Choice>(&*message)) {
    if (!std::exchange(choosing_, false))
      return usage_error("choose: no trial waits for a simulated observer");
    choice_ = *choice;
    return FeedEvent::kChoice;
  }
  if (Failure failure = add(experiment, std::get<file::TrialFields>(*message))) return *failure;
  return FeedEvent::kTrial;
}

// The first trial decides the columns.
Result<file::AnswerColumns> TrialFeed::columns_with(const Experiment& experiment,
                                                    const file::TrialFields& fields) const {
  if (experiment.answers.columns()) return *experiment.answers.columns();
  file::AnswerColumns columns;
  columns.extras = file::extra_columns_of(fields);
  std::vector<std::string> names;
  for (const auto& [name, field] : fields) names.push_back(name);
  if (Failure failure = file::check_extra_columns(names)) return *failure;
  const Result<file::TrialSpec> trial = file::read_trial(fields, columns.extras);
  if (!trial) return trial.error();
  columns.keys = keys_of(std::array{*trial});
  if (columns.keys.size() > kMaxKeys)
    return usage_error(fmt::format("more than {} keys", kMaxKeys));
  return columns;
}

// Changes nothing but after all checks.
Failure TrialFeed::add(Experiment& experiment, const file::TrialFields& fields) {
  // A break has no keys, and does not decide the columns.
  const auto kind = fields.find("kind");
  const bool is_break = kind != fields.end() && file::trimmed(kind->second) == "break";
  const Result<file::AnswerColumns> columns =
      is_break ? experiment.answers.columns().value_or(
                     file::AnswerColumns{true, {}, file::extra_columns_of(fields)})
               : columns_with(experiment, fields);
  if (!columns) return columns.error();
  Result<file::TrialSpec> trial = file::read_trial(fields, columns->extras);
  if (!trial) return trial.error();
  if (trial->number == 0) trial->number = next_number(experiment);
  if (Failure failure = check_number(experiment, *trial)) return failure;
  if (Failure failure = check_keys(*trial, *columns)) return failure;
  Result<SlotScenes> scenes = loader_.load(*trial);
  if (!scenes) return scenes.error();
  if (!is_break && !experiment.answers.columns()) {
    if (Failure failure = experiment.answers.set_columns(*columns)) return failure;
  }
  experiment.trials.push_back(std::move(*trial));
  experiment.scenes.push_back(std::move(*scenes));
  return std::nullopt;
}

}  // namespace hapticwall::session
