// Result of a blind test.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/ui/page/blind_test_page.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using compare::PairResult;
using compare::TrialResult;
using file::Answer;

constexpr float kFiguresShare = 0.45F;  // of the width; the trials stand in the rest
constexpr float kMaxFiguresEms = 38.0F;
constexpr float kResultGapEms = 1.5F;

std::string share_text(std::uint32_t count, std::uint32_t trials) {
  if (trials == 0) return "–";
  return fmt::format("{} of {}, {:.0f} %", count, trials,
                     kPercent * static_cast<double>(count) / static_cast<double>(trials));
}

// The verdict in words, at the chosen confidence. Pairs of a list are points of a curve instead.
std::string verdict(const BlindTest& test) {
  const TrialResult& result = test.results.tests;
  if (test.answers.empty()) return "No trial was answered.";
  if (test.experiment) return "Answers: " + test.experiment->answers.path();
  if (result.p_value > 1.0 - test.trials.plan().confidence) {
    return fmt::format("No difference is shown: choosing by chance explains it (p = {:.3g}).",
                       result.p_value);
  }
  return fmt::format("{} was chosen more often than chance explains (p = {:.3g}).",
                     2 * result.chose_a > result.trials ? "A" : "B", result.p_value);
}

std::string interval_text(const TrialResult& result) {
  return fmt::format("{:.1f} to {:.1f} %", kPercent * result.a.low, kPercent * result.a.high);
}

// Of the trials of a list.
void draw_list_figures(const PanelContext& context, const compare::TrialResults& results) {
  figure_row(context, "correct", share_text(results.tests.correct, results.tests.judged),
             draw::Tone::kText, "Right answers, of the trials that have one");
  figure_row(context, "catch trials", share_text(results.catches.correct, results.catches.judged),
             draw::Tone::kText,
             "Right answers to catch trials. Few of them mean that the participant did not attend");
  figure_row(context, "practice", fmt::format("{}", results.practice), draw::Tone::kText,
             "Answered practice trials, which no other line counts");
}

// Of the two walls of a plain test.
void draw_pair_figures(const PanelContext& context, const BlindTest& test) {
  const TrialResult& result = test.results.tests;
  figure_row(context, "chose A", share_text(result.chose_a, result.trials), draw::Tone::kText,
             "How often the answer was A");
  figure_row(
      context, "share of A",
      fmt::format("{}, at {:g} %", interval_text(result), kPercent * test.trials.plan().confidence),
      draw::Tone::kText, "The exact Clopper-Pearson interval for the share of A");
  figure_row(context, "p-value", fmt::format("{:.4g}", result.p_value), draw::Tone::kText,
             "Probability of an outcome at least as far from one half by chance: exact, two-sided");
}

void draw_figures(const PanelContext& context, const BlindTest& test) {
  const TrialResult& result = test.results.tests;
  figure_row(context, "answered",
             fmt::format("{} of {}", test.answers.size(), test.trials.planned()), draw::Tone::kText,
             "Answered trials, of the planned ones");
  if (test.experiment) {
    draw_list_figures(context, test.results);
  } else {
    draw_pair_figures(context, test);
  }
  figure_row(context, "chose the first", share_text(result.chose_first, result.trials),
             draw::Tone::kText,
             "A share far from one half means that the order was judged, not the walls");
  figure_row(context, "seed", fmt::format("{}", test.trials.plan().seed), draw::Tone::kText,
             "The same seed gives the same order");
}

// The answers to a list are stored already.
void draw_save(const PanelContext& context, const BlindTest& test) {
  const bool saved = !test.saved_as.empty();
  if (button(saved ? "Saved###blind save" : "Save###blind save",
             saved ? test.saved_as + "-trials.csv\n" + test.saved_as + "-result.csv"
                   : "Writes two CSV files into the recording folder: one line per trial, and the "
                     "result",
             {.enabled = !saved}))
    save_blind_test(context);
  ImGui::SameLine();
}

void draw_actions(const PanelContext& context, const BlindTest& test) {
  if (!test.experiment) draw_save(context, test);
  if (button("New test###new blind test",
             "Back to the set-up; this result stays until the next test starts"))
    context.state.compare.transient.setting_up = true;
}

void draw_summary(const PanelContext& context, const BlindTest& test) {
  ImGui::PushFont(context.theme.fonts.strong, draw::kTitleFontSize);
  ImGui::TextWrapped("%s", test.experiment ? test.experiment->name.c_str()
                                           : test.trials.plan().trials.front().question.c_str());
  ImGui::PopFont();
  ImGui::TextWrapped("%s", verdict(test).c_str());
  if (!test.experiment) {
    muted_text(context, "A  " + test.trials.plan().trials.front().slots[0]);
    muted_text(context, "B  " + test.trials.plan().trials.front().slots[1]);
  }
  ImGui::Spacing();
  draw_figures(context, test);
  ImGui::Spacing();
  draw_actions(context, test);
}

template <std::size_t kCount>
void draw_row(const std::array<std::string, kCount>& cells) {
  ImGui::TableNextRow();
  for (const std::string& cell : cells) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(cell.c_str());
  }
}

void draw_trial_row(std::size_t index, const Answer& answer) {
  draw_row(std::array{fmt::format("{}", index + 1),
                      fmt::format("{}, {}", compare::slot_name(answer.first),
                                  compare::slot_name(compare::other(answer.first))),
                      fmt::format("{}, {}", compare::slot_name(answer.chosen),
                                  answer.chosen == answer.first ? "1st" : "2nd"),
                      fmt::format("{}", answer.looks), fmt::format("{:.1f} s", answer.seconds)});
}

// "wall.stiffness_n_per_m=1000" as "1000" where the keys are those of the other slot.
std::string short_slot(const std::string& slot, const std::string& other_slot) {
  const std::vector<std::string> texts = file::slot_overrides(slot);
  const std::vector<std::string> others = file::slot_overrides(other_slot);
  const auto key_of = [](const std::string& text) { return text.substr(0, text.find('=')); };
  if (!std::ranges::equal(texts, others, {}, key_of, key_of)) return slot;
  std::string values;
  for (const std::string& text : texts)
    values += (values.empty() ? "" : "; ") + text.substr(text.find('=') + 1);
  return values;
}

void draw_pair_row(const PairResult& pair) {
  const TrialResult& result = pair.result;
  draw_row(std::array{std::string(file::kind_name(pair.kind)), short_slot(pair.a, pair.b),
                      short_slot(pair.b, pair.a), share_text(result.chose_a, result.trials),
                      interval_text(result), share_text(result.correct, result.judged)});
}

template <std::size_t kCount>
bool begin_table(const std::array<const char*, kCount>& columns) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("trials", static_cast<int>(kCount), kFlags)) return false;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* column : columns) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
  return true;
}

void draw_trials(const BlindTest& test) {
  const FontScope font(nullptr, draw::kSmallFontSize);
  if (!begin_table(std::array{"trial", "order", "chosen", "looks", "time"})) return;
  for (std::size_t i = 0; i < test.answers.size(); ++i) draw_trial_row(i, test.answers[i]);
  ImGui::EndTable();
}

void draw_pairs(const BlindTest& test) {
  const FontScope font(nullptr, draw::kSmallFontSize);
  if (!begin_table(std::array{"kind", "A", "B", "chose A", "interval", "correct"})) return;
  for (const PairResult& pair : test.results.pairs) draw_pair_row(pair);
  ImGui::EndTable();
}

}  // namespace

void draw_blind_result(const PanelContext& context) {
  const BlindTest& test = *context.state.compare.transient.test;
  const float width =
      std::min(kFiguresShare * ImGui::GetContentRegionAvail().x, ems(kMaxFiguresEms));
  ImGui::BeginChild("summary", ImVec2(width, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_summary(context, test);
  ImGui::EndChild();
  ImGui::SameLine(0.0F, ems(kResultGapEms));
  ImGui::BeginChild("list", ImVec2(0.0F, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  test.experiment ? draw_pairs(test) : draw_trials(test);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
