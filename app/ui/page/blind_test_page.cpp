#include "app/ui/page/blind_test_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/file/text/text.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/comparing.h"
#include "app/ui/widget/sliders.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using compare::Slot;

constexpr float kFieldsShare = 0.5F;  // share of the width; the rest explains the test
constexpr float kMaxFieldsEms = 34.0F;
constexpr float kPageGapEms = 2.0F;

void draw_question(const PanelContext& context) {
  std::string& question = context.compare.persisted.question;
  field_label(context, "question", "The question of the trial list", "");
  const auto typed = text_field(context, "##blind question", "", question);
  if (typed) question = *typed;
}

void draw_trials(const PanelContext& context) {
  std::size_t& trials = context.compare.persisted.trials;
  const std::string tooltip = fmt::format(
      "Number of trials, 1 to {}. A and B are first equally often.", compare::kMaxTrials);
  const auto typed =
      number_row(context, {"blind trials", "trials", "", tooltip, static_cast<double>(trials)});
  if (!typed) return;
  if (*typed != std::round(*typed) || *typed < 1.0 ||
      *typed > static_cast<double>(compare::kMaxTrials)) {
    refuse(context, "blind trials",
           fmt::format("{} is no whole number from 1 to {}", rounded_number(*typed),
                       compare::kMaxTrials));
    return;
  }
  trials = static_cast<std::size_t>(*typed);
}

void draw_confidence(const PanelContext& context) {
  double& confidence = context.compare.persisted.confidence;
  const auto typed =
      number_row(context, {"blind confidence", "confidence", "%",
                           "Confidence of the exact Clopper-Pearson interval for the share of A",
                           confidence * kPercent});
  if (!typed) return;
  if (*typed < kMinConfidence * kPercent || *typed > kMaxConfidence * kPercent) {
    refuse(context, "blind confidence",
           fmt::format("{} is not from {} to {} %", rounded_number(*typed),
                       kMinConfidence * kPercent, kMaxConfidence * kPercent));
    return;
  }
  confidence = *typed / kPercent;
}

void draw_masking(const PanelContext& context) {
  field_label(context, "sound", "", "");
  ImGui::Checkbox("masking noise###masking noise", &context.compare.persisted.masking_noise);
  explain(
      "During the test the sound, if it is on, is noise that does not depend on the wall. "
      "Switch this off if the question is about the sound.");
}

void draw_fields(const PanelContext& context) {
  draw_question(context);
  draw_trials(context);
  draw_confidence(context);
  draw_masking(context);
  ImGui::Spacing();
  if (button(
          "Write the trial list###blind list",
          "Writes a CSV file of equal trials into the recording folder. The program runs it with "
          "--trials."))
    write_trial_list(context);
  if (!context.compare.transient.test) return;
  ImGui::SameLine();
  if (button("Last result###last result", "The result of the trial list."))
    context.compare.transient.setting_up = false;
}

void draw_slot(const PanelContext& context, const CompareSlots& slots, Slot slot) {
  const std::string keys = set_keys_text(slots.of(slot));
  const std::string name(compare::slot_name(slot));
  ImGui::TextColored(context.theme.colour(draw::Tone::kAccent), "%s", name.c_str());
  ImGui::SameLine();
  ImGui::TextWrapped("%s%s", algorithm_name(slots.of(slot)).c_str(),
                     keys.empty() ? "" : (", " + keys).c_str());
}

void draw_what_happens(const PanelContext& context) {
  const CompareSlots slots = slots_of(context.compare);
  draw_slot(context, slots, Slot::kA);
  draw_slot(context, slots, Slot::kB);
  if (slots.of(Slot::kA) == slots.of(Slot::kB)) {
    draw::wrapped_text(context.theme.colour(draw::Tone::kWarning),
                       "Both slots are equal: there is no difference to feel.");
  }
  ImGui::Spacing();
  muted_text(
      context,
      "In each trial there are two walls, one of A and one of B. Feel either as often as you "
      "like, then choose. The force switches at once, blended over 50 ms. To begin from rest, "
      "leave the wall before you switch.");
  ImGui::Spacing();
  muted_text(
      context,
      "Until the end the window shows only the handle and the walls, and every answer is "
      "stored at once. A spreadsheet may change the list: other keys, catch trials, breaks.");
}

}  // namespace

void draw_blind_setup(const PanelContext& context) {
  draw::strong_text(context.theme, "Blind test");
  const float width = std::min(kFieldsShare * ImGui::GetContentRegionAvail().x, ems(kMaxFieldsEms));
  ImGui::BeginChild("fields", ImVec2(width, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_fields(context);
  ImGui::EndChild();
  ImGui::SameLine(0.0F, ems(kPageGapEms));
  ImGui::BeginChild("what happens",
                    ImVec2(std::min(ImGui::GetContentRegionAvail().x, ems(kMaxFieldsEms)), 0.0F),
                    ImGuiChildFlags_None, ImGuiWindowFlags_NoBackground);
  draw_what_happens(context);
  ImGui::EndChild();
}

void draw_blind_test_page(const PanelContext& context) {
  const CompareState::Transient& compare = context.compare.transient;
  if (blind_test_runs(context.compare)) {
    draw_blind_trial(context);
  } else if (compare.test && !compare.setting_up) {
    draw_blind_result(context);
  } else {
    draw_blind_setup(context);
  }
}

}  // namespace hapticwall::ui
