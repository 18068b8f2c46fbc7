#include "app/file/trials/trial_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "core/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxListBytes = std::size_t{1} << 20U;
constexpr const char* kUsualBreak = "Rest as long as you like.";

// A reader takes one field and returns its problem, or "".
using ReadField = std::string (*)(const std::string& field, TrialSpec& trial);

std::string read_text(const std::string& field, std::string& text) {
  if (field.size() > kMaxTrialBytes) return fmt::format("longer than {} bytes", kMaxTrialBytes);
  if (!field.empty()) text = field;
  return "";
}

std::string read_number(const std::string& field, TrialSpec& trial) {
  const auto number = parsed<std::uint64_t>(field);
  if (!number || *number == 0) return in_quotes(field) + " is no whole number from 1";
  trial.number = *number;
  return "";
}

std::string read_block(const std::string& field, TrialSpec& trial) {
  return read_text(field, trial.block);
}

std::string read_kind(const std::string& field, TrialSpec& trial) {
  if (field.empty()) return "";
  const auto kind = find_trial_kind(field);
  if (!kind) return fmt::format("{}; it takes {}", in_quotes(field), joined(kTrialKinds));
  trial.kind = *kind;
  return "";
}

std::string read_a(const std::string& field, TrialSpec& trial) {
  trial.slots[0] = field;
  return "";
}

std::string read_b(const std::string& field, TrialSpec& trial) {
  trial.slots[1] = field;
  return "";
}

std::string read_question(const std::string& field, TrialSpec& trial) {
  if (trial.kind == TrialKind::kBreak) trial.question = kUsualBreak;
  return read_text(field, trial.question);
}

std::string read_correct(const std::string& field, TrialSpec& trial) {
  if (field.empty()) return "";
  if (field != "a" && field != "b") return in_quotes(field) + "; it takes a or b, or nothing";
  trial.correct = field == "a" ? Slot::kA : Slot::kB;
  return "";
}

struct ListColumn {
  std::string_view name;
  ReadField read;
};
// Columns are read in this order, in whatever order the file has them.
constexpr std::array kListColumns{ListColumn{"trial", read_number},
                                  ListColumn{"block", read_block},
                                  ListColumn{"kind", read_kind},
                                  ListColumn{"a", read_a},
                                  ListColumn{"b", read_b},
                                  ListColumn{"question", read_question},
                                  ListColumn{"correct", read_correct}};

// The place of each column in the rows; nullopt: absent.
using Places = std::array<std::optional<std::size_t>, kListColumns.size()>;

Result<Places> places_of(const std::vector<std::string>& header) {
  const std::vector<std::string_view> names = names_of(kListColumns, &ListColumn::name);
  Places places;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const auto found = std::ranges::find(names, header[i]);
    if (found == names.end()) {
      const std::string hint = suggestion(header[i], names);
      return usage_error(fmt::format("{} is no column{}", in_quotes(header[i]),
                                     hint.empty() ? "; it takes " + joined(names) : hint));
    }
    auto& place = places.at(static_cast<std::size_t>(found - names.begin()));
    if (place) return usage_error(fmt::format("two columns {}", *found));
    place = i;
  }
  for (const std::size_t needed : {3U, 4U}) {
    if (!places.at(needed))
      return usage_error(fmt::format("the column {} is missing", kListColumns.at(needed).name));
  }
  return places;
}

// Contradictions between the fields of a row.
std::string problem_of(const TrialSpec& trial) {
  const bool equal = trial.slots[0] == trial.slots[1];
  if (trial.kind == TrialKind::kBreak) {
    const bool bare = equal && trial.slots[0].empty() && !trial.correct;
    return bare ? "" : "kind break: it takes a question alone, as its text";
  }
  if (equal && trial.slots[0].empty() && trial.kind != TrialKind::kCatch)
    return "a and b are both empty; one of them takes KEY=VALUE";
  if (equal && trial.correct) return "correct: a and b are equal, so that neither is right";
  if (trial.kind == TrialKind::kCatch && !equal && !trial.correct)
    return "kind catch: it takes equal a and b, or the right answer in the column correct";
  return "";
}

Result<TrialSpec> read_row(const std::vector<std::string>& fields, const Places& places) {
  TrialSpec trial;
  for (std::size_t i = 0; i < kListColumns.size(); ++i) {
    const std::string field = places[i] ? std::string(trimmed(fields[*places[i]])) : "";
    if (!places[i] && kListColumns[i].read == read_number) continue;
    const std::string problem = kListColumns[i].read(field, trial);
    if (!problem.empty()) return usage_error(fmt::format("{}: {}", kListColumns[i].name, problem));
  }
  const std::string problem = problem_of(trial);
  if (!problem.empty()) return usage_error(problem);
  return trial;
}

bool has_control(std::string_view line) {
  while (!line.empty()) {
    if (starts_with_control(line)) return true;
    line.remove_prefix(utf8_length(line));
  }
  return false;
}

Result<std::vector<std::string>> read_fields(std::string_view line) {
  if (!is_utf8(line)) return usage_error("it is not UTF-8");
  if (has_control(line)) return usage_error("it has a control character");
  auto fields = csv_fields(line);
  if (!fields) return usage_error("its quotes do not match");
  return std::move(*fields);
}

// Reads one list, line by line.
class ListReader {
 public:
  Failure add_line(std::string_view line) {
    ++line_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) return std::nullopt;
    Result<std::vector<std::string>> fields = read_fields(line);
    if (!fields) return fields.error();
    return places_ ? add_row(*fields) : add_header(*fields);
  }
  Failure end() {
    if (!places_) return usage_error("it has no line of columns");
    const bool any = std::ranges::any_of(
        list_.trials, [](const TrialSpec& trial) { return trial.kind != TrialKind::kBreak; });
    if (!any) return usage_error("it has no trial");
    return std::nullopt;
  }
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] TrialList& list() { return list_; }

 private:
  Failure add_header(const std::vector<std::string>& fields) {
    const Result<Places> places = places_of(fields);
    if (!places) return places.error();
    places_ = *places;
    columns_ = fields.size();
    return std::nullopt;
  }
  Failure add_row(const std::vector<std::string>& fields) {
    if (fields.size() != columns_)
      return usage_error(fmt::format("{} fields for {} columns", fields.size(), columns_));
    if (list_.trials.size() == kMaxTrials)
      return usage_error(fmt::format("more than {} trials", kMaxTrials));
    Result<TrialSpec> trial = read_row(fields, *places_);
    if (!trial) return trial.error();
    if (!places_->front()) trial->number = list_.trials.size() + 1;
    if (!numbers_.insert(trial->number).second)
      return usage_error(fmt::format("trial: {} stands twice", trial->number));
    trial->line = line_;
    list_.trials.push_back(std::move(*trial));
    return std::nullopt;
  }

  TrialList list_;
  std::optional<Places> places_;
  std::size_t columns_ = 0;
  std::size_t line_ = 0;
  std::set<std::uint64_t> numbers_;
};

}  // namespace

std::optional<TrialKind> find_trial_kind(std::string_view name) {
  const auto found = std::ranges::find(kTrialKinds, name);
  if (found == kTrialKinds.end()) return std::nullopt;
  return static_cast<TrialKind>(found - kTrialKinds.begin());
}

std::vector<std::string> slot_overrides(std::string_view slot) {
  std::vector<std::string> overrides;
  for (const std::string_view part : split(slot, ';')) {
    const std::string_view text = trimmed(part);
    if (!text.empty()) overrides.emplace_back(text);
  }
  return overrides;
}

Result<TrialList> parse_trial_list(std::string_view text, const std::string& origin) {
  Sha256 digest;
  digest.update(text);
  text = without_byte_order_mark(text);
  ListReader reader;
  for (const std::string_view line : split(text, '\n')) {
    if (const Failure failure = reader.add_line(line)) {
      return usage_error(fmt::format("{}:{}: {}", shown(origin), reader.line(), failure->message));
    }
  }
  if (const Failure failure = reader.end())
    return usage_error(fmt::format("{}: {}", shown(origin), failure->message));
  reader.list().sha256 = digest.finish();
  return std::move(reader.list());
}

Result<TrialList> read_trial_list(const std::string& path) {
  const Result<std::string> text = read_small_file(path, "trial list", kMaxListBytes);
  if (!text) return text.error();
  return parse_trial_list(*text, path);
}

}  // namespace hapticwall::file
