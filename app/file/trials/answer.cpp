#include "app/file/trials/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "app/file/text/text.h"
#include "core/text.h"

namespace hapticwall::file {
namespace {

std::string field_text(const std::string& value) { return value; }
std::string field_text(std::uint64_t value) { return fmt::format("{}", value); }
std::string field_text(std::uint32_t value) { return fmt::format("{}", value); }
std::string field_text(double value) { return shortest_number(value); }
std::string field_text(Slot value) { return std::string(slot_name(value)); }
std::string field_text(TrialKind value) { return std::string(kind_name(value)); }
std::string field_text(std::optional<std::uint64_t> value) {
  return value ? field_text(*value) : "";
}
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
bool set_field(std::string_view text, std::optional<std::uint64_t>& value) {
  if (text.empty()) return true;
  value = parsed<std::uint64_t>(text);
  return value.has_value();
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

template <auto kMember>
constexpr AnswerColumn exposure_column(std::string_view name) {
  return {name, [](const Answer& answer) { return field_text(answer.exposure.*kMember); },
          [](std::string_view text, Answer& answer) {
            return set_field(text, answer.exposure.*kMember);
          }};
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

constexpr std::array kExposureColumns{
    exposure_column<&ExposureRow::contact_s>("contact_s"),
    exposure_column<&ExposureRow::mean_force_n>("mean_force_n"),
    exposure_column<&ExposureRow::max_force_n>("max_force_n"),
    exposure_column<&ExposureRow::energy_to_hand_j>("energy_to_hand_j"),
    exposure_column<&ExposureRow::touches>("touches"),
    exposure_column<&ExposureRow::lost_ticks>("lost_ticks"),
    exposure_column<&ExposureRow::recording>("recording"),
    exposure_column<&ExposureRow::first_tick>("first_tick"),
    exposure_column<&ExposureRow::last_tick>("last_tick")};

// Columns that all files with these AnswerColumns have, in order.
std::vector<AnswerColumn> built_in_columns(const AnswerColumns& columns) {
  std::vector<AnswerColumn> all(kAnswerColumns.begin(), kAnswerColumns.end());
  if (columns.exposure) all.insert(all.end(), kExposureColumns.begin(), kExposureColumns.end());
  return all;
}

std::vector<std::string> names_in(const AnswerColumns& columns) {
  std::vector<std::string> names;
  for (const AnswerColumn& column : built_in_columns(columns)) names.emplace_back(column.name);
  for (const std::string& key : columns.keys) {
    names.push_back("a." + key);
    names.push_back("b." + key);
  }
  names.insert(names.end(), columns.extras.begin(), columns.extras.end());
  return names;
}

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields)
    line += (&field == fields.data() ? "" : ",") + csv_field(field);
  return line + '\n';
}

std::vector<std::string> texts_of(const Answer& answer, const AnswerColumns& columns) {
  std::vector<std::string> texts;
  for (const AnswerColumn& column : built_in_columns(columns)) texts.push_back(column.text(answer));
  const auto add = [&](std::vector<std::string> values, std::size_t count) {
    values.resize(count);
    texts.insert(texts.end(), values.begin(), values.end());
  };
  add(answer.values, 2 * columns.keys.size());
  add(answer.extras, columns.extras.size());
  return texts;
}

}  // namespace

bool is_answer_column(std::string_view name) {
  const std::vector<AnswerColumn> all = built_in_columns({});
  return std::ranges::find(all, name, &AnswerColumn::name) != all.end();
}

std::string answers_header(const AnswerColumns& columns) { return line_of(names_in(columns)); }

std::string answer_line(const Answer& answer, const AnswerColumns& columns) {
  return line_of(texts_of(answer, columns));
}

std::vector<std::pair<std::string, std::string>> answer_fields(const Answer& answer,
                                                               const AnswerColumns& columns) {
  const std::vector<std::string> names = names_in(columns);
  const std::vector<std::string> texts = texts_of(answer, columns);
  std::vector<std::pair<std::string, std::string>> fields;
  for (std::size_t i = 0; i < names.size(); ++i) fields.emplace_back(names[i], texts[i]);
  return fields;
}

std::optional<AnswerColumns> parse_answers_header(std::string_view line) {
  const auto names = csv_fields(line);
  if (!names) return std::nullopt;
  AnswerColumns columns;
  columns.exposure = names->size() > kAnswerColumns.size();
  std::size_t at = built_in_columns(columns).size();
  for (; at + 1 < names->size() && (*names)[at].starts_with("a."); at += 2)
    columns.keys.push_back((*names)[at].substr(2));
  for (; at < names->size(); ++at) columns.extras.push_back((*names)[at]);
  return answers_header(columns) == std::string(line) + '\n' ? std::optional(columns)
                                                             : std::nullopt;
}

std::optional<Answer> parse_answer(std::string_view line, const AnswerColumns& columns) {
  const auto fields = csv_fields(line);
  if (!fields || fields->size() != names_in(columns).size()) return std::nullopt;
  Answer answer;
  const std::vector<AnswerColumn> known = built_in_columns(columns);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!known[i].read((*fields)[i], answer)) return std::nullopt;
  }
  const auto values = fields->begin() + static_cast<std::ptrdiff_t>(known.size());
  const auto extras = values + static_cast<std::ptrdiff_t>(2 * columns.keys.size());
  answer.values.assign(values, extras);
  answer.extras.assign(extras, fields->end());
  // Compares also the columns that follow from others.
  return answer_line(answer, columns) == std::string(line) + '\n' ? std::optional(answer)
                                                                  : std::nullopt;
}

}  // namespace hapticwall::file
