// Trials that another program gives one at a time, each from the answers so far
// (docs/experiments.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/file/trials/answers_file.h"
#include "app/file/trials/trial_message.h"
#include "app/session/line_pipe.h"
#include "app/session/trial_slots.h"

namespace hapticwall::session {

struct Experiment;

enum class FeedEvent : std::uint8_t {
  kNothing,
  kTrial,   // Experiment::trials and ::scenes have one more
  kEnd,     // no further trial
  kChoice,  // of a simulated observer; see choice()
  kLeft,    // the other program has gone, without an end
};

// The protocol. A wrong line is answered with one line that says why, and changes nothing. No
// member waits. Call all of them from the owner's thread. Realtime-safe: no.
class TrialFeed {
 public:
  TrialFeed(std::unique_ptr<LinePipe> pipe, SlotLoader loader)
      : pipe_(std::move(pipe)), loader_(std::move(loader)) {}
  TrialFeed(const TrialFeed&) = delete;
  TrialFeed& operator=(const TrialFeed&) = delete;
  ~TrialFeed() { end("closed"); }

  // Hands over the stored answers, puts their trials before all others, and asks for the next one.
  void begin(Experiment& experiment);
  // The answer is stored.
  void answered(const Experiment& experiment, const file::Answer& answer);
  void ask(const Experiment& experiment);
  // Handles the lines that have come, up to the first one that is an event.
  [[nodiscard]] FeedEvent take(Experiment& experiment);
  // Why the experiment ends. No effect after the first call.
  void end(std::string_view why);

  // Asks the simulated observer; the choice is an event of take().
  void ask_to_choose(const std::string& felt_line) {
    choosing_ = true;
    pipe_->send(felt_line);
  }
  [[nodiscard]] file::Choice choice() const { return choice_; }
  // Waits for a line, for a program without a window.
  void wait(std::chrono::milliseconds longest) { pipe_->wait(longest); }

  // What was wrong with the newest line; empty after a right one.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  [[nodiscard]] Result<FeedEvent> handle(Experiment& experiment, const std::string& line);
  [[nodiscard]] Failure add(Experiment& experiment, const file::TrialFields& fields);
  [[nodiscard]] Result<file::AnswerColumns> columns_with(const Experiment& experiment,
                                                         const file::TrialFields& fields) const;

  std::unique_ptr<LinePipe> pipe_;
  SlotLoader loader_;
  bool ended_ = false;
  bool choosing_ = false;
  file::Choice choice_;
  std::string problem_;
};

}  // namespace hapticwall::session
