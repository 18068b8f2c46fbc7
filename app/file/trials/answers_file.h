// The answers of one participant in one session of an experiment, as a CSV file
// (docs/experiments.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/trials/answer.h"
#include "core/result.h"

namespace hapticwall::file {

// Appends answers to a file that it locks. An answer is on the disk when append() returns: a killed
// program keeps it. Realtime-safe: no.
class AnswersFile {
 public:
  // Creates the file, or continues it. `identity` has what all its answers share: participant,
  // session, seed, scene and list. Refuses (exit status 2) a file with anything else, and changes
  // nothing then. Drops a torn last line, see dropped(). nullopt as `columns`: those of the file
  // hold, and a new file needs set_columns() before its first answer. A file of an earlier version
  // keeps its columns.
  [[nodiscard]] static Result<AnswersFile> open(
      const std::string& path, const Answer& identity,
      const std::optional<AnswerColumns>& columns = AnswerColumns{});

  AnswersFile(AnswersFile&& other) noexcept;
  AnswersFile& operator=(AnswersFile&& other) noexcept;
  AnswersFile(const AnswersFile&) = delete;
  AnswersFile& operator=(const AnswersFile&) = delete;
  ~AnswersFile();

  // nullopt before set_columns().
  [[nodiscard]] const std::optional<AnswerColumns>& columns() const { return columns_; }
  // Writes the line of columns. Precondition: there are none yet.
  [[nodiscard]] Failure set_columns(const AnswerColumns& columns);
  // The answer with the fields that all answers share.
  [[nodiscard]] Answer signed_answer(Answer answer) const;
  // One line with the fields that all answers share, then fsync. After a failure (exit status 4)
  // the file is as before, where the disk allows it. Precondition: columns().
  [[nodiscard]] Failure append(const Answer& answer);

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
  [[nodiscard]] Failure read_columns(std::string_view text);
  [[nodiscard]] Failure read_lines(std::string_view whole);
  void take_older_seed(std::uint64_t seed);
  [[nodiscard]] Failure check(const Answer& answer) const;
  [[nodiscard]] Failure write_durably(std::string_view text);
  [[nodiscard]] Error failure() const;  // reads errno

  std::string path_;
  Answer identity_;
  std::optional<AnswerColumns> columns_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;  // bytes of whole lines
  std::vector<Answer> found_;
  bool dropped_ = false;
};

}  // namespace hapticwall::file
