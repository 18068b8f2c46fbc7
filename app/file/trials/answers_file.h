// The answers of one participant in one session of an experiment, as a CSV file
// (docs/experiments.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/trials/trial_list.h"
#include "core/result.h"

namespace hapticwall::file {

// Programs that read every number as a double, such as R, read it exactly.
inline constexpr std::uint64_t kMaxSeed = std::uint64_t{1} << 53U;

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

  friend bool operator==(const Answer&, const Answer&) = default;
};

// The line of columns, and the lines of answers, each with its end.
[[nodiscard]] std::string answers_header();
[[nodiscard]] std::string answer_line(const Answer& answer);
// Parses a line without its end; nullopt for anything that answer_line() does not write.
[[nodiscard]] std::optional<Answer> parse_answer(std::string_view line);

// Appends answers to a file that it locks. An answer is on the disk when append() returns: a killed
// program keeps it. Realtime-safe: no.
class AnswersFile {
 public:
  // Creates the file, or continues it. `identity` has what all its answers share: participant,
  // session, seed, scene and list. Refuses (exit status 2) a file with anything else, and changes
  // nothing then. Drops a torn last line, see dropped().
  [[nodiscard]] static Result<AnswersFile> open(const std::string& path, const Answer& identity);

  AnswersFile(AnswersFile&& other) noexcept;
  AnswersFile& operator=(AnswersFile&& other) noexcept;
  AnswersFile(const AnswersFile&) = delete;
  AnswersFile& operator=(const AnswersFile&) = delete;
  ~AnswersFile();

  // One line with the fields that all answers share, then fsync. After a failure (exit status 4)
  // the file is as before, where the disk allows it.
  [[nodiscard]] Failure append(Answer answer);

  // Answers that open() found.
  [[nodiscard]] std::span<const Answer> found() const { return found_; }
  // The end of the file was a torn line, which a kill leaves; it is gone.
  [[nodiscard]] bool dropped() const { return dropped_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  // Answer with the fields that all answers share.
  [[nodiscard]] const Answer& identity() const { return identity_; }

 private:
  AnswersFile(std::string path, Answer identity, int descriptor);
  [[nodiscard]] Failure read();
  [[nodiscard]] Failure read_lines(std::string_view whole);
  void take_older_seed(std::uint64_t seed);
  [[nodiscard]] Failure check(const Answer& answer) const;
  [[nodiscard]] Failure write_durably(std::string_view text);
  [[nodiscard]] Error failure() const;  // reads errno

  std::string path_;
  Answer identity_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;  // bytes of whole lines
  std::vector<Answer> found_;
  bool dropped_ = false;
};

}  // namespace hapticwall::file
