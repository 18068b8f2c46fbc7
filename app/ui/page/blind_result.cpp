// Result of a blind test.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/ui/page/blind_test_page.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using compare::PairResult;
using compare::TrialResult;

constexpr float kFiguresShare = 0.45F;  // share of the width; the trials stand in the rest
constexpr float kMaxFiguresEms = 38.0F;
constexpr float kResultGapEms = 1.5F;

std::string share_text(std::uint32_t count, std::uint32_t trials) {
  if (trials == 0) return "–";
  return fmt::format("{} of {}, {:.0f} %", count, trials,
                     kPercent * static_cast<double>(count) / static_cast<double>(trials));
}

std::string interval_text(const TrialResult& result) {
  return fmt::format("{:.1f} to {:.1f} %", kPercent * result.a.low, kPercent * result.a.high);
}

// Draws the results of the trials of a list.
void draw_list_figures(const PanelContext& context, const compare::TrialResults& results) {
  figure_row(context, "correct", share_text(results.tests.correct, results.tests.judged),
             draw::Tone::kText, "Right answers, of the trials that have one");
  figure_row(context, "catch trials", share_text(results.catches.correct, results.catches.judged),
             draw::Tone::kText,
             "Right answers to catch trials. Few of them mean that the participant did not attend");
  figure_row(context, "practice", fmt::format("{}", results.practice), draw::Tone::kText,
             "Answered practice trials, which no other line counts");
}

void draw_figures(const PanelContext& context, const BlindTest& test) {
  const TrialResult& result = test.results.tests;
  figure_row(context, "answered",
             fmt::format("{} of {}", test.answers.size(), test.trials.planned()), draw::Tone::kText,
             "Answered trials, of the planned ones");
  draw_list_figures(context, test.results);
  figure_row(context, "chose the first", share_text(result.chose_first, result.trials),
             draw::Tone::kText,
             "A share far from one half means that the order was judged, not the walls");
  figure_row(context, "seed", fmt::format("{}", test.trials.plan().seed), draw::Tone::kText,
             "The same seed gives the same order");
}

void draw_summary(const PanelContext& context, const BlindTest& test) {
  ImGui::PushFont(context.theme.fonts.strong, draw::kTitleFontSize);
  ImGui::TextWrapped("%s", test.experiment->name.c_str());
  ImGui::PopFont();
  const std::string answers = test.answers.empty() ? "No trial was answered."
                                                   : "Answers: " + test.experiment->answers.path();
  ImGui::TextWrapped("%s", answers.c_str());
  ImGui::Spacing();
  draw_figures(context, test);
  ImGui::Spacing();
  if (button("New list###new blind test", "Back to the set-up; this result stays"))
    context.compare.transient.setting_up = true;
}

template <std::size_t kCount>
void draw_row(const std::array<std::string, kCount>& cells) {
  ImGui::TableNextRow();
  for (const std::string& cell : cells) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(cell.c_str());
  }
}

// "wall.stiffness_n_per_m=1000" becomes "1000" if the other slot has the same keys.
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

void draw_pairs(const BlindTest& test) {
  const FontScope font(nullptr, draw::kSmallFontSize);
  if (!begin_table(std::array{"kind", "A", "B", "chose A", "interval", "correct"})) return;
  for (const PairResult& pair : test.results.pairs) draw_pair_row(pair);
  ImGui::EndTable();
}

}  // namespace

void draw_blind_result(const PanelContext& context) {
  const BlindTest& test = *context.compare.transient.test;
  const float width =
      std::min(kFiguresShare * ImGui::GetContentRegionAvail().x, ems(kMaxFiguresEms));
  ImGui::BeginChild("summary", ImVec2(width, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_summary(context, test);
  ImGui::EndChild();
  ImGui::SameLine(0.0F, ems(kResultGapEms));
  ImGui::BeginChild("list", ImVec2(0.0F, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_pairs(test);
  ImGui::EndChild();
}

}  // namespace hapticwall::ui
