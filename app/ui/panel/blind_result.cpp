// What a blind test has found.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/blind_test.h"
#include "app/ui/blind_test_page.h"
#include "app/ui/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using runtime::Trial;
using runtime::TrialResult;

constexpr float kFiguresShare = 0.52F;  // of the width; the trials stand in the rest
constexpr float kWidestFiguresEms = 38.0F;
constexpr float kResultGapEms = 1.5F;

std::string share_text(std::uint32_t count, std::uint32_t trials) {
  if (trials == 0) return "–";
  return fmt::format("{} of {}, {:.0f} %", count, trials,
                     kPercent * static_cast<double>(count) / static_cast<double>(trials));
}

// In words, at the confidence that was asked for.
std::string verdict(const TrialResult& result, double confidence) {
  if (result.trials == 0) return "No trial was answered.";
  if (result.p_value > 1.0 - confidence) {
    return fmt::format("No difference is shown: choosing by chance explains it (p = {:.3g}).",
                       result.p_value);
  }
  return fmt::format("{} was chosen more often than chance explains (p = {:.3g}).",
                     2 * result.chose_a > result.trials ? "A" : "B", result.p_value);
}

void draw_figures(const PanelContext& context, const BlindTest& test) {
  const TrialResult& result = test.trials.result();
  const runtime::TrialPlan& plan = test.trials.plan();
  figure_row(context, "answered", fmt::format("{} of {}", result.trials, plan.trials), Tone::kText,
             "Trials with an answer, of those that were planned");
  remember_item(context.state, "blind answered");
  figure_row(context, "chose A", share_text(result.chose_a, result.trials), Tone::kText,
             "How often the answer was A");
  remember_item(context.state, "blind share");
  figure_row(context, "share of A",
             fmt::format("{:.1f} to {:.1f} %, at {:g} %", kPercent * result.a.low,
                         kPercent * result.a.high, kPercent * plan.confidence),
             Tone::kText,
             "The exact interval of Clopper and Pearson: every share under which neither so many "
             "answers nor so few are improbable");
  remember_item(context.state, "blind interval");
  figure_row(context, "p-value", fmt::format("{:.4g}", result.p_value), Tone::kText,
             "How probable an outcome at least as far from a half is, by chance alone: exact, "
             "two-sided");
  remember_item(context.state, "blind p-value");
  figure_row(context, "chose the first", share_text(result.chose_first, result.trials), Tone::kText,
             "Far from a half, the order was judged, and not the walls");
  remember_item(context.state, "blind first");
  figure_row(context, "seed", fmt::format("{}", plan.seed), Tone::kText,
             "The same seed gives the same order");
}

void draw_actions(const PanelContext& context, const BlindTest& test) {
  ImGui::BeginDisabled(!test.saved_as.empty());
  const bool save = ImGui::Button(test.saved_as.empty() ? "Save###save" : "Saved###save");
  ImGui::EndDisabled();
  remember_item(context.state, "blind save");
  explain(test.saved_as.empty()
              ? "Writes two CSV files into the recording folder: a line a trial, and the result"
              : test.saved_as + "-trials.csv\n" + test.saved_as + "-result.csv");
  ImGui::SameLine();
  if (ImGui::Button("New test")) context.state.compare.transient.setting_up = true;
  remember_item(context.state, "new blind test");
  explain("Back to the set-up; this result stays until the next test starts");
  if (save) save_blind_test(context);
}

void draw_summary(const PanelContext& context, const BlindTest& test) {
  ImGui::PushFont(context.theme.fonts.strong, kTitleFontSize);
  ImGui::TextWrapped("%s", test.trials.plan().question.c_str());
  ImGui::PopFont();
  ImGui::TextWrapped("%s", verdict(test.trials.result(), test.trials.plan().confidence).c_str());
  remember_item(context.state, "blind verdict");
  muted_text(context, "A  " + test.a);
  muted_text(context, "B  " + test.b);
  ImGui::Spacing();
  draw_figures(context, test);
  ImGui::Spacing();
  draw_actions(context, test);
}

void draw_trial_row(std::size_t index, const Trial& trial) {
  const bool chose_first = trial.chosen == trial.first;
  const std::array<std::string, 5> cells{
      fmt::format("{}", index + 1),
      fmt::format("{}, {}", runtime::slot_name(trial.first),
                  runtime::slot_name(runtime::other(trial.first))),
      fmt::format("{}, {}", runtime::slot_name(trial.chosen), chose_first ? "1st" : "2nd"),
      fmt::format("{}", trial.looks), fmt::format("{:.1f} s", trial.seconds)};
  ImGui::TableNextRow();
  for (const std::string& cell : cells) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(cell.c_str());
  }
}

void draw_trials(const PanelContext& context, const BlindTest& test) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  constexpr std::array kColumns{"trial", "order", "chosen", "looks", "time"};
  ImGui::PushFont(nullptr, kSmallFontSize);
  if (ImGui::BeginTable("trials", static_cast<int>(kColumns.size()), kFlags)) {
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const char* column : kColumns) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    const std::vector<Trial>& trials = test.trials.trials();
    for (std::size_t i = 0; i < trials.size(); ++i) draw_trial_row(i, trials[i]);
    ImGui::EndTable();
  }
  ImGui::PopFont();
  remember_item(context.state, "blind trial list");
}

}  // namespace

void draw_blind_result(const PanelContext& context) {
  const BlindTest& test = *context.state.compare.transient.test;
  const float em = ImGui::GetFontSize();
  const float width =
      std::min(kFiguresShare * ImGui::GetContentRegionAvail().x, kWidestFiguresEms * em);
  ImGui::BeginChild("summary", ImVec2(width, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_summary(context, test);
  ImGui::EndChild();
  ImGui::SameLine(0.0F, kResultGapEms * em);
  ImGui::BeginChild("list", ImVec2(0.0F, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_trials(context, test);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
