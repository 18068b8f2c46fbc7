// Result of a blind test.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/page/blind_test_page.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using compare::Trial;
using compare::TrialResult;

constexpr float kFiguresShare = 0.52F;  // of the width; the trials stand in the rest
constexpr float kMaxFiguresEms = 38.0F;
constexpr float kResultGapEms = 1.5F;

std::string share_text(std::uint32_t count, std::uint32_t trials) {
  if (trials == 0) return "–";
  return fmt::format("{} of {}, {:.0f} %", count, trials,
                     kPercent * static_cast<double>(count) / static_cast<double>(trials));
}

// The verdict in words, at the chosen confidence.
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
  const compare::TrialPlan& plan = test.trials.plan();
  figure_row(context, "answered", fmt::format("{} of {}", result.trials, plan.trials),
             draw::Tone::kText, "Answered trials, of the planned ones");
  figure_row(context, "chose A", share_text(result.chose_a, result.trials), draw::Tone::kText,
             "How often the answer was A");
  figure_row(context, "share of A",
             fmt::format("{:.1f} to {:.1f} %, at {:g} %", kPercent * result.a.low,
                         kPercent * result.a.high, kPercent * plan.confidence),
             draw::Tone::kText, "The exact Clopper-Pearson interval for the share of A");
  figure_row(context, "p-value", fmt::format("{:.4g}", result.p_value), draw::Tone::kText,
             "Probability of an outcome at least as far from one half by chance: exact, two-sided");
  figure_row(context, "chose the first", share_text(result.chose_first, result.trials),
             draw::Tone::kText,
             "A share far from one half means that the order was judged, not the walls");
  figure_row(context, "seed", fmt::format("{}", plan.seed), draw::Tone::kText,
             "The same seed gives the same order");
}

void draw_actions(const PanelContext& context, const BlindTest& test) {
  const bool saved = !test.saved_as.empty();
  const bool save = button(
      saved ? "Saved###blind save" : "Save###blind save",
      saved ? test.saved_as + "-trials.csv\n" + test.saved_as + "-result.csv"
            : "Writes two CSV files into the recording folder: one line per trial, and the result",
      {.enabled = !saved});
  ImGui::SameLine();
  if (button("New test###new blind test",
             "Back to the set-up; this result stays until the next test starts"))
    context.state.compare.transient.setting_up = true;
  if (save) save_blind_test(context);
}

void draw_summary(const PanelContext& context, const BlindTest& test) {
  ImGui::PushFont(context.theme.fonts.strong, draw::kTitleFontSize);
  ImGui::TextWrapped("%s", test.trials.plan().question.c_str());
  ImGui::PopFont();
  ImGui::TextWrapped("%s", verdict(test.trials.result(), test.trials.plan().confidence).c_str());
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
      fmt::format("{}, {}", compare::slot_name(trial.first),
                  compare::slot_name(compare::other(trial.first))),
      fmt::format("{}, {}", compare::slot_name(trial.chosen), chose_first ? "1st" : "2nd"),
      fmt::format("{}", trial.looks), fmt::format("{:.1f} s", trial.seconds)};
  ImGui::TableNextRow();
  for (const std::string& cell : cells) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(cell.c_str());
  }
}

void draw_trials(const BlindTest& test) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  constexpr std::array kColumns{"trial", "order", "chosen", "looks", "time"};
  const FontScope font(nullptr, draw::kSmallFontSize);
  if (!ImGui::BeginTable("trials", static_cast<int>(kColumns.size()), kFlags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* column : kColumns) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
  const std::vector<Trial>& trials = test.trials.trials();
  for (std::size_t i = 0; i < trials.size(); ++i) draw_trial_row(i, trials[i]);
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
  draw_trials(test);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
