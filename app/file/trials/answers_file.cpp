#include "app/file/trials/answers_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
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

std::string field_text(const std::string& value) { return value; }
std::string field_text(std::uint64_t value) { return fmt::format("{}", value); }
std::string field_text(std::uint32_t value) { return fmt::format("{}", value); }
std::string field_text(double value) { return shortest_number(value); }
std::string field_text(Slot value) { return std::string(slot_name(value)); }
std::string field_text(TrialKind value) { return std::string(kind_name(value)); }
std::string field_text(std::optional<bool> value) { return !value ? "" : *value ? "1" : "0"; }

bool set_field(std::string_view text, std::string& value) {
  value = text;
  return true;
}
template <typename Number>
bool set_field(std::string_view text, Number& value) {
  const auto number = parsed<Number>(text);
  if (number) value = *number;
  return number.has_value();
}
bool set_field(std::string_view text, Slot& value) {
  value = text == slot_name(Slot::kA) ? Slot::kA : Slot::kB;
  return text == slot_name(value);
}
bool set_field(std::string_view text, TrialKind& value) {
  const auto kind = find_trial_kind(text);
  if (kind) value = *kind;
  return kind.has_value();
}
bool set_field(std::string_view text, std::optional<bool>& value) {
  if (!text.empty()) value = text == "1";
  return text == field_text(value);
}

struct AnswerColumn {
  std::string_view name;
  std::string (*text)(const Answer& answer);
  bool (*read)(std::string_view text, Answer& answer);
};
template <auto kMember>
constexpr AnswerColumn column(std::string_view name) {
  return {name, [](const Answer& answer) { return field_text(answer.*kMember); },
          [](std::string_view text, Answer& answer) { return set_field(text, answer.*kMember); }};
}

std::string second_text(const Answer& answer) { return field_text(other(answer.first)); }
std::string presentation_text(const Answer& answer) {
  return answer.chosen == answer.first ? "1" : "2";
}
// Reads a column that follows from others.
bool follows(std::string_view /*text*/, Answer& /*answer*/) { return true; }

constexpr std::array kAnswerColumns{column<&Answer::participant>("participant"),
                                    column<&Answer::session>("session"),
                                    column<&Answer::time_utc>("time_utc"),
                                    column<&Answer::trial>("trial"),
                                    column<&Answer::block>("block"),
                                    column<&Answer::kind>("kind"),
                                    column<&Answer::question>("question"),
                                    column<&Answer::a>("a"),
                                    column<&Answer::b>("b"),
                                    column<&Answer::first>("first"),
                                    AnswerColumn{"second", second_text, follows},
                                    column<&Answer::chosen>("chosen"),
                                    AnswerColumn{"chosen_presentation", presentation_text, follows},
                                    column<&Answer::correct>("correct"),
                                    column<&Answer::looks>("looks"),
                                    column<&Answer::seconds>("seconds"),
                                    column<&Answer::seed>("seed"),
                                    column<&Answer::program>("program"),
                                    column<&Answer::scene_sha256>("scene_sha256"),
                                    column<&Answer::list_sha256>("list_sha256")};

// One field per column, with a line end.
template <typename Field>
std::string line_of(const Field& field) {
  std::string line;
  for (const AnswerColumn& column : kAnswerColumns)
    line += (line.empty() ? "" : ",") + csv_field(field(column));
  return line + '\n';
}

}  // namespace

std::string answers_header() {
  return line_of([](const AnswerColumn& column) { return column.name; });
}

std::string answer_line(const Answer& answer) {
  return line_of([&](const AnswerColumn& column) { return column.text(answer); });
}

std::optional<Answer> parse_answer(std::string_view line) {
  const auto fields = csv_fields(line);
  if (!fields || fields->size() != kAnswerColumns.size()) return std::nullopt;
  Answer answer;
  for (std::size_t i = 0; i < kAnswerColumns.size(); ++i) {
    if (!kAnswerColumns[i].read((*fields)[i], answer)) return std::nullopt;
  }
  // Compares also the columns that follow from others.
  return answer_line(answer) == std::string(line) + '\n' ? std::optional(answer) : std::nullopt;
}

Result<AnswersFile> AnswersFile::open(const std::string& path, const Answer& identity) {
  const Result<int> descriptor = open_own(path, {O_RDWR | O_APPEND, kAnswersMode, path});
  if (!descriptor) return descriptor.error();
  AnswersFile file(path, identity, *descriptor);
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
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      found_(std::move(other.found_)),
      dropped_(other.dropped_) {}

AnswersFile& AnswersFile::operator=(AnswersFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(identity_, other.identity_);
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
  const std::string header = answers_header();
  const bool begins = header.starts_with(text);  // true also for a new file
  if (!begins && !text.starts_with(header)) {
    return usage_error(
        fmt::format("{}: not a file of answers; choose another name for them", shown(path_)));
  }
  size_ = begins ? (text == header ? text.size() : 0) : text.rfind('\n') + 1;
  if (Failure failure = read_lines(std::string_view(text).substr(0, size_))) return failure;
  dropped_ = size_ < text.size();
  if (dropped_ && ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) return failure();
  return size_ == 0 ? write_durably(header) : std::nullopt;
}

Failure AnswersFile::read_lines(std::string_view whole) {
  std::size_t number = 0;
  for (const std::string_view line : split(whole, '\n')) {
    if (++number == 1 || line.empty()) continue;
    const std::optional<Answer> answer = parse_answer(line);
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

Failure AnswersFile::append(Answer answer) {
  answer.participant = identity_.participant;
  answer.session = identity_.session;
  answer.seed = identity_.seed;
  answer.program = identity_.program;
  answer.scene_sha256 = identity_.scene_sha256;
  answer.list_sha256 = identity_.list_sha256;
  return write_durably(answer_line(answer));
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
