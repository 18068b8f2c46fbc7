#include "app/file/trials/answers_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "core/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxAnswersBytes = std::size_t{1} << 24U;
// Readable by the user only, because answers are personal data.
constexpr mode_t kAnswersMode = 0600;

// The names that every file begins with, without a line end.
std::string common_header() {
  std::string header = answers_header({false, {}, {}});
  header.pop_back();
  return header;
}

}  // namespace

Result<AnswersFile> AnswersFile::open(const std::string& path, const Answer& identity,
                                      const std::optional<AnswerColumns>& columns) {
  const Result<int> descriptor = open_own(path, {O_RDWR | O_APPEND, kAnswersMode, path});
  if (!descriptor) return descriptor.error();
  AnswersFile file(path, identity, *descriptor);
  file.columns_ = columns;
  const Result<std::string> place = replaceable_path(path);  // fails if read-only, also for root
  if (!place) return place.error();
  if (const Failure failure = file.read()) return *failure;
  sync_folder(path);
  return file;
}

AnswersFile::AnswersFile(std::string path, Answer identity, int descriptor)
    : path_(std::move(path)), identity_(std::move(identity)), descriptor_(descriptor) {}

AnswersFile::AnswersFile(AnswersFile&& other) noexcept
    : path_(std::move(other.path_)),
      identity_(std::move(other.identity_)),
      columns_(std::move(other.columns_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      found_(std::move(other.found_)),
      dropped_(other.dropped_) {}

AnswersFile& AnswersFile::operator=(AnswersFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(identity_, other.identity_);
  std::swap(columns_, other.columns_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  std::swap(found_, other.found_);
  std::swap(dropped_, other.dropped_);
  return *this;
}

AnswersFile::~AnswersFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

Error AnswersFile::failure() const {
  return file_error(fmt::format("{}: cannot be written: {}", shown(path_),
                                std::generic_category().message(errno)));
}

// Changes no member before the whole file was understood.
Failure AnswersFile::read() {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) return failure();
  std::string text;
  if (status.st_size > 0) {
    Result<std::string> found = read_small_file(path_, "file of answers", kMaxAnswersBytes);
    if (!found) return found.error();
    text = std::move(*found);
  }
  if (Failure failure = read_columns(text)) return failure;
  size_ = text.rfind('\n') + 1;  // 0 without a whole line of columns
  if (Failure failure = read_lines(std::string_view(text).substr(0, size_))) return failure;
  dropped_ = size_ < text.size();
  if (found_.empty()) size_ = 0;  // columns alone are written anew
  if (size_ < text.size() && ftruncate(descriptor_, static_cast<off_t>(size_)) != 0)
    return failure();
  return size_ == 0 && columns_ ? write_durably(answers_header(*columns_)) : std::nullopt;
}

// Takes the columns of the file, where it has a whole line of them.
Failure AnswersFile::read_columns(std::string_view text) {
  const std::size_t end = text.find('\n');
  const std::string common = common_header();
  if (end == std::string_view::npos && (common.starts_with(text) || text.starts_with(common)))
    return std::nullopt;
  const auto found =
      end == std::string_view::npos ? std::nullopt : parse_answers_header(text.substr(0, end));
  if (!found) {
    return usage_error(
        fmt::format("{}: not a file of answers; choose another name for them", shown(path_)));
  }
  if (text.find('\n', end + 1) == std::string_view::npos) return std::nullopt;  // no answer
  const bool continues = !columns_ ? found->exposure : *found == *columns_ || !found->exposure;
  if (!continues) {
    return usage_error(
        fmt::format("{}: its columns are not those of these trials; choose another file with "
                    "--answers",
                    shown(path_)));
  }
  columns_ = found;
  return std::nullopt;
}

Failure AnswersFile::read_lines(std::string_view whole) {
  std::size_t number = 0;
  for (const std::string_view line : split(whole, '\n')) {
    if (++number == 1 || line.empty()) continue;
    const std::optional<Answer> answer = columns_ ? parse_answer(line, *columns_) : std::nullopt;
    if (!answer) {
      return usage_error(fmt::format("{}:{}: not an answer; repair the line or choose another name",
                                     shown(path_), number));
    }
    if (found_.empty()) take_older_seed(answer->seed);
    if (Failure failure = check(*answer)) return failure;
    found_.push_back(*answer);
  }
  return std::nullopt;
}

// Earlier programs used 64 bits of the same hash. Their sessions keep their order.
void AnswersFile::take_older_seed(std::uint64_t seed) {
  constexpr unsigned kMoreBits = 12;
  if (seed > kMaxSeed && seed >> kMoreBits == identity_.seed) identity_.seed = seed;
}

Failure AnswersFile::check(const Answer& answer) const {
  const auto refused = [&](const std::string& what) {
    return usage_error(fmt::format("{}: it has answers {}; choose another file with --answers",
                                   shown(path_), what));
  };
  if (answer.participant != identity_.participant)
    return refused("of participant " + in_quotes(answer.participant));
  if (answer.session != identity_.session)
    return refused("of session " + in_quotes(answer.session));
  if (answer.list_sha256 != identity_.list_sha256) return refused("to another trial list");
  if (answer.scene_sha256 != identity_.scene_sha256) return refused("on another scene");
  if (answer.seed != identity_.seed) return refused("in another order");
  return std::nullopt;
}

Failure AnswersFile::set_columns(const AnswerColumns& columns) {
  if (Failure failure = write_durably(answers_header(columns))) return failure;
  columns_ = columns;
  return std::nullopt;
}

Answer AnswersFile::signed_answer(Answer answer) const {
  answer.participant = identity_.participant;
  answer.session = identity_.session;
  answer.seed = identity_.seed;
  answer.program = identity_.program;
  answer.scene_sha256 = identity_.scene_sha256;
  answer.list_sha256 = identity_.list_sha256;
  return answer;
}

Failure AnswersFile::append(const Answer& answer) {
  return write_durably(answer_line(signed_answer(answer), *columns_));
}

Failure AnswersFile::write_durably(std::string_view text) {
  const ssize_t written = ::write(descriptor_, text.data(), text.size());
  const bool whole = written == static_cast<ssize_t>(text.size());
  if (whole && fsync(descriptor_) == 0) {
    size_ += text.size();
    return std::nullopt;
  }
  if (written >= 0 && !whole) errno = ENOSPC;  // a part: the disk is full
  Error error = failure();
  if (ftruncate(descriptor_, static_cast<off_t>(size_)) != 0)
    error.message += "; its last line may be torn";
  return error;
}

}  // namespace hapticwall::file
