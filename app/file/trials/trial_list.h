// A trial list: the trials of an experiment in a CSV file (docs/experiments.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace hapticwall::file {

// The two walls of a trial.
enum class Slot : std::uint8_t { kA, kB };

[[nodiscard]] constexpr Slot other(Slot slot) { return slot == Slot::kA ? Slot::kB : Slot::kA; }
[[nodiscard]] constexpr std::string_view slot_name(Slot slot) {
  return slot == Slot::kA ? "A" : "B";
}

enum class TrialKind : std::uint8_t { kPractice, kTest, kCatch, kBreak };
// Names in a trial list, in the order of TrialKind.
inline constexpr std::array<std::string_view, 4> kTrialKinds{"practice", "test", "catch", "break"};
[[nodiscard]] constexpr std::string_view kind_name(TrialKind kind) {
  return kTrialKinds.at(static_cast<std::size_t>(kind));
}
[[nodiscard]] std::optional<TrialKind> find_trial_kind(std::string_view name);

inline constexpr std::size_t kMaxTrials = 1000;      // trials of a list, with its breaks
inline constexpr std::size_t kMaxTrialBytes = 200;   // bytes of a question or a block name, UTF-8
inline constexpr std::size_t kMaxExtraColumns = 32;  // further columns of a list
inline constexpr const char* kUsualQuestion = "Which wall is stiffer?";

// A row of the list.
struct TrialSpec {
  std::uint64_t number = 0;  // unique in its list
  std::string block;
  TrialKind kind = TrialKind::kTest;
  std::array<std::string, 2> slots;       // settings of A and B; see slot_overrides()
  std::string question = kUsualQuestion;  // or the text of a break
  std::optional<Slot> correct;            // the right answer, if there is one
  std::size_t line = 0;                   // line in the file, from 1
  std::vector<std::string> extras;        // fields of the further columns, as in the list
};

struct TrialList {
  std::vector<TrialSpec> trials;
  std::vector<std::string> extras;  // names of the further columns, which the answers repeat
  std::string sha256;               // hash of the file
};

// "KEY=VALUE; KEY=VALUE" as texts of --set.
[[nodiscard]] std::vector<std::string> slot_overrides(std::string_view slot);

// The key of "KEY=VALUE", as a scene file has it: "algorithm" is "algorithm.name".
[[nodiscard]] std::string override_key(std::string_view text);

// One trial from its fields by column, with the checks of a row of a list. Every other field is one
// of a further column; `extras` has their order, and extra fields that it lacks are refused.
// Without a number the trial has number 0.
using TrialFields = std::map<std::string, std::string, std::less<>>;
[[nodiscard]] Result<TrialSpec> read_trial(const TrialFields& fields,
                                           const std::vector<std::string>& extras);
// Names of the further columns among these fields, sorted.
[[nodiscard]] std::vector<std::string> extra_columns_of(const TrialFields& fields);
// Refuses a further column without a name, with one of the answers, or one that is nearly a column
// of a list which `columns` lack, and more than kMaxExtraColumns.
[[nodiscard]] Failure check_extra_columns(const std::vector<std::string>& columns);

// Checks everything but the overrides, which need a scene. `origin` names the list in messages
// ("list.csv:7: kind ...").
[[nodiscard]] Result<TrialList> parse_trial_list(std::string_view text, const std::string& origin);
[[nodiscard]] Result<TrialList> read_trial_list(const std::string& path);

}  // namespace hapticwall::file
