// The answer to a trial, and its line in the file of answers (docs/experiments.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/file/trials/trial_list.h"

namespace hapticwall::file {

// Programs that read every number as a double, such as R, read it exactly.
inline constexpr std::uint64_t kMaxSeed = std::uint64_t{1} << 53U;

// Columns of a file of answers beside those that every file has.
struct AnswerColumns {
  bool exposure = true;             // false: a file of an earlier version, without all of these
  std::vector<std::string> keys;    // keys that the walls change: columns a.KEY and b.KEY
  std::vector<std::string> extras;  // further columns of the trial list

  friend bool operator==(const AnswerColumns&, const AnswerColumns&) = default;
};

// Forces that a participant met in a trial, from the first presentation to the choice.
struct ExposureRow {
  double contact_s = 0.0;
  double mean_force_n = 0.0;      // magnitude, over the ticks in contact
  double max_force_n = 0.0;       // magnitude
  double energy_to_hand_j = 0.0;  // net work of the force on the hand; negative: taken from it
  std::uint64_t touches = 0;
  std::uint64_t lost_ticks = 0;             // ticks that the window did not get
  std::string recording;                    // file name of the running recording, or ""
  std::optional<std::uint64_t> first_tick;  // nullopt without a tick
  std::optional<std::uint64_t> last_tick;

  friend bool operator==(const ExposureRow&, const ExposureRow&) = default;
};

// One answered trial, a line of the file.
struct Answer {
  std::string participant;
  std::string session;
  std::string time_utc;     // time of the choice, ISO 8601
  std::uint64_t trial = 0;  // number of the trial in the list
  std::string block;
  TrialKind kind = TrialKind::kTest;
  std::string question;
  std::string a;  // contents of the slots
  std::string b;
  Slot first = Slot::kA;  // slot of the first presentation
  Slot chosen = Slot::kA;
  std::optional<bool> correct;  // nullopt: the trial has no right answer
  std::uint32_t looks = 0;      // presentations felt before the choice
  double seconds = 0.0;         // time from the first of these presentations to the choice
  std::uint64_t seed = 0;       // seed of the order of presentations; in new files at most kMaxSeed
  std::string program;          // version and build
  std::string scene_sha256;     // hash of the scene as TOML, without the slots
  std::string list_sha256;
  ExposureRow exposure;
  std::vector<std::string> values;  // of the keys: a.KEY and b.KEY by turns
  std::vector<std::string> extras;  // of the further columns

  friend bool operator==(const Answer&, const Answer&) = default;
};

// True if every file of answers has a column of this name.
[[nodiscard]] bool is_answer_column(std::string_view name);
// The line of columns, and the lines of answers, each with its end.
[[nodiscard]] std::string answers_header(const AnswerColumns& columns = {});
[[nodiscard]] std::string answer_line(const Answer& answer, const AnswerColumns& columns = {});
// Parses a line without its end; nullopt for anything that the two above do not write.
[[nodiscard]] std::optional<AnswerColumns> parse_answers_header(std::string_view line);
[[nodiscard]] std::optional<Answer> parse_answer(std::string_view line,
                                                 const AnswerColumns& columns = {});
// Names and texts of all columns of an answer, in order.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> answer_fields(
    const Answer& answer, const AnswerColumns& columns);

}  // namespace hapticwall::file
