#include "app/file/trials/trial_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "app/file/trials/answer.h"
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
struct Places {
  std::array<std::optional<std::size_t>, kListColumns.size()> known;
  std::vector<std::size_t> extras;
};

std::vector<std::string_view> column_names() { return names_of(kListColumns, &ListColumn::name); }

// Problem of the name of a further column, or "". A name that is nearly one of ours is a slip.
std::string extra_problem(std::string_view name, const std::vector<std::string_view>& absent) {
  if (name.empty()) return "a column has no name";
  if (name.size() > kMaxTrialBytes)
    return fmt::format("a column's name is longer than {} bytes", kMaxTrialBytes);
  if (is_answer_column(name) || name.starts_with("a.") || name.starts_with("b."))
    return in_quotes(name) + " is a column of the answers; choose another name";
  const std::string hint = suggestion(name, absent);
  return hint.empty() ? "" : fmt::format("{} is no column{}", in_quotes(name), hint);
}

Failure check_needed(const Places& places) {
  for (const std::size_t needed : {3U, 4U}) {
    if (!places.known.at(needed))
      return usage_error(fmt::format("the column {} is missing", kListColumns.at(needed).name));
  }
  return std::nullopt;
}

Result<Places> places_of(const std::vector<std::string>& header) {
  const std::vector<std::string_view> names = column_names();
  Places places;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const auto found = std::ranges::find(names, header[i]);
    if (std::ranges::count(header, header[i]) > 1)
      return usage_error(fmt::format("two columns {}", shown(header[i])));
    if (found != names.end()) {
      places.known.at(static_cast<std::size_t>(found - names.begin())) = i;
      continue;
    }
    places.extras.push_back(i);
  }
  if (const Failure failure = check_extra_columns(header)) return *failure;
  if (const Failure failure = check_needed(places)) return *failure;
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

// `field_of(i)`: the field of a column of kListColumns, nullopt if absent.
template <typename FieldOf>
Result<TrialSpec> read_known(const FieldOf& field_of) {
  TrialSpec trial;
  for (std::size_t i = 0; i < kListColumns.size(); ++i) {
    const std::optional<std::string> found = field_of(i);
    if (!found && kListColumns[i].read == read_number) continue;
    const std::string problem =
        kListColumns[i].read(std::string(trimmed(found.value_or(""))), trial);
    if (!problem.empty()) return usage_error(fmt::format("{}: {}", kListColumns[i].name, problem));
  }
  const std::string problem = problem_of(trial);
  if (!problem.empty()) return usage_error(problem);
  return trial;
}

Failure add_extra(TrialSpec& trial, std::string_view name, const std::string& field) {
  if (field.size() > kMaxTrialBytes)
    return usage_error(fmt::format("{}: longer than {} bytes", shown(name), kMaxTrialBytes));
  trial.extras.push_back(field);
  return std::nullopt;
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
    header_ = fields;
    for (const std::size_t place : places_->extras) list_.extras.push_back(fields[place]);
    return std::nullopt;
  }
  Failure add_row(const std::vector<std::string>& fields) {
    if (fields.size() != header_.size())
      return usage_error(fmt::format("{} fields for {} columns", fields.size(), header_.size()));
    if (list_.trials.size() == kMaxTrials)
      return usage_error(fmt::format("more than {} trials", kMaxTrials));
    Result<TrialSpec> trial = read_known([&](std::size_t i) {
      const auto& place = places_->known.at(i);
      return place ? std::optional(fields[*place]) : std::nullopt;
    });
    if (!trial) return trial.error();
    for (const std::size_t place : places_->extras) {
      if (Failure failure = add_extra(*trial, header_[place], fields[place])) return failure;
    }
    if (!places_->known.front()) trial->number = list_.trials.size() + 1;
    if (!numbers_.insert(trial->number).second)
      return usage_error(fmt::format("trial: {} stands twice", trial->number));
    trial->line = line_;
    list_.trials.push_back(std::move(*trial));
    return std::nullopt;
  }

  TrialList list_;
  std::optional<Places> places_;
  std::vector<std::string> header_;
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

std::string override_key(std::string_view text) {
  const std::string key(trimmed(text.substr(0, text.find('='))));
  return key == "algorithm" || key == "estimator" ? key + ".name" : key;
}

std::vector<std::string> extra_columns_of(const TrialFields& fields) {
  const std::vector<std::string_view> names = column_names();
  std::vector<std::string> extras;
  for (const auto& [name, field] : fields) {
    if (std::ranges::find(names, name) == names.end()) extras.push_back(name);
  }
  return extras;
}

Failure check_extra_columns(const std::vector<std::string>& columns) {
  const std::vector<std::string_view> known = column_names();
  std::vector<std::string_view> absent;
  for (const std::string_view name : known) {
    if (std::ranges::find(columns, name) == columns.end()) absent.push_back(name);
  }
  std::size_t extras = 0;
  for (const std::string& name : columns) {
    if (std::ranges::find(known, name) != known.end()) continue;
    ++extras;
    if (const std::string problem = extra_problem(name, absent); !problem.empty())
      return usage_error(problem);
  }
  if (extras <= kMaxExtraColumns) return std::nullopt;
  return usage_error(fmt::format("more than {} further columns", kMaxExtraColumns));
}

Result<TrialSpec> read_trial(const TrialFields& fields, const std::vector<std::string>& extras) {
  for (const auto& [name, field] : fields) {
    if (has_control(name) || has_control(field))
      return usage_error(shown(name) + ": it has a control character");
  }
  for (const std::string& name : extra_columns_of(fields)) {
    if (std::ranges::find(extras, name) == extras.end()) {
      return usage_error(
          fmt::format("{}: the first trial has no such column; name all in it", shown(name)));
    }
  }
  Result<TrialSpec> trial = read_known([&](std::size_t i) {
    const auto found = fields.find(kListColumns.at(i).name);
    return found == fields.end() ? std::nullopt : std::optional(found->second);
  });
  if (!trial) return trial;
  for (const std::string& name : extras) {
    const auto found = fields.find(name);
    if (const Failure failure =
            add_extra(*trial, name, found == fields.end() ? std::string() : found->second))
      return *failure;
  }
  return trial;
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
