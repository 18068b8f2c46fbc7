#include "app/ui/blind_test_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "app/ui/blind_test.h"
#include "app/ui/comparing.h"
#include "app/ui/replay_state.h"
#include "app/ui/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using runtime::Slot;

constexpr float kFieldsShare = 0.5F;  // of the width; what happens is told in the rest
constexpr float kWidestFieldsEms = 34.0F;
constexpr float kPageGapEms = 2.0F;

void draw_question(const PanelContext& context) {
  std::string& question = context.state.compare.persisted.question;
  field_label(context, "question", "What is to be decided, for the page and the files", "");
  const auto typed = text_field(context, "##question", "", question);
  remember_item(context.state, "blind question");
  if (typed) question = *typed;
}

void draw_trials(const PanelContext& context) {
  std::size_t& trials = context.state.compare.persisted.trials;
  field_label(context, "trials",
              fmt::format("How often both walls are felt, in a new order, 1 to {}. The first is as "
                          "often A as B.",
                          runtime::kMostTrials),
              "");
  const auto typed = number_field(context, "##trials", static_cast<double>(trials));
  remember_item(context.state, "blind trials");
  if (!typed) return;
  if (*typed != std::round(*typed) || *typed < 1.0 ||
      *typed > static_cast<double>(runtime::kMostTrials)) {
    tell(context.state, MessageKind::kProblem,
         fmt::format("trials: {} is no whole number from 1 to {}", number_text(*typed),
                     runtime::kMostTrials));
    return;
  }
  trials = static_cast<std::size_t>(*typed);
}

void draw_confidence(const PanelContext& context) {
  double& confidence = context.state.compare.persisted.confidence;
  field_label(context, "confidence",
              "Of the interval for the share of A (Clopper and Pearson: exact)", "%");
  const auto typed = number_field(context, "##confidence", confidence * kPercent);
  remember_item(context.state, "blind confidence");
  unit_label("%");
  if (!typed) return;
  if (*typed < kLeastConfidence * kPercent || *typed > kMostConfidence * kPercent) {
    tell(context.state, MessageKind::kProblem,
         fmt::format("confidence: {} is not from {} to {} %", number_text(*typed),
                     kLeastConfidence * kPercent, kMostConfidence * kPercent));
    return;
  }
  confidence = *typed / kPercent;
}

std::optional<std::uint64_t> parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return seed;
}

void draw_seed(const PanelContext& context) {
  std::optional<std::uint64_t>& seed = context.state.compare.transient.seed;
  field_label(
      context, "seed",
      "Decides the order, alone: the same seed, the same order. Empty: by chance; the files "
      "tell it afterwards.",
      "");
  const auto typed =
      text_field(context, "##seed", "by chance", seed ? fmt::format("{}", *seed) : "");
  remember_item(context.state, "blind seed");
  if (!typed) return;
  const auto parsed = parse_seed(*typed);
  if (!parsed && !typed->empty()) {
    tell(context.state, MessageKind::kProblem,
         fmt::format("seed: '{}' is no whole number from 0 to 2^64 - 1", *typed));
    return;
  }
  seed = parsed;
}

void draw_fields(const PanelContext& context) {
  draw_question(context);
  draw_trials(context);
  draw_confidence(context);
  draw_seed(context);
  ImGui::Spacing();
  const bool replaying = replay_of(context.session) != nullptr;
  ImGui::BeginDisabled(replaying);
  if (ImGui::Button("Start the blind test")) start_blind_test(context);
  ImGui::EndDisabled();
  remember_item(context.state, "blind start");
  explain(
      replaying
          ? "A recording cannot be felt: go back to the scene first."
          : "Hides all that could give the order away, until the last trial or \"Stop and show\".");
  if (!context.state.compare.transient.test) return;
  ImGui::SameLine();
  if (ImGui::Button("Last result")) context.state.compare.transient.setting_up = false;
  remember_item(context.state, "last result");
  explain("Of the test before. The next one takes its place when it starts.");
}

void draw_slot(const PanelContext& context, const CompareSlots& slots, Slot slot) {
  const std::string keys = set_keys_text(slots.of(slot));
  const std::string name(runtime::slot_name(slot));
  ImGui::TextColored(context.theme.colour(Tone::kAccent), "%s", name.c_str());
  ImGui::SameLine();
  ImGui::TextWrapped("%s%s", algorithm_name(slots.of(slot)).c_str(),
                     keys.empty() ? "" : (", " + keys).c_str());
}

void draw_what_happens(const PanelContext& context) {
  const CompareSlots slots = slots_of(context.state);
  draw_slot(context, slots, Slot::kA);
  draw_slot(context, slots, Slot::kB);
  if (slots.of(Slot::kA) == slots.of(Slot::kB)) {
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.colour(Tone::kWarning));
    ImGui::TextWrapped("Both are the same: there is nothing to be told apart.");
    ImGui::PopStyleColor();
  }
  ImGui::Spacing();
  muted_text(
      context,
      "In each trial there are two walls, one of A and one of B. Feel either as often as you "
      "like, then choose. The switch takes place at once, wherever the handle is, blended "
      "over 50 ms; leave the wall before it to begin from rest.");
  ImGui::Spacing();
  muted_text(context,
             "Until the end the window shows the handle and the walls only. A recording may run: "
             "its files keep the order.");
}

}  // namespace

void draw_blind_setup(const PanelContext& context) {
  ImGui::PushFont(context.theme.fonts.strong, 0.0F);
  ImGui::TextUnformatted("Blind test");
  ImGui::PopFont();
  const float em = ImGui::GetFontSize();
  const float width =
      std::min(kFieldsShare * ImGui::GetContentRegionAvail().x, kWidestFieldsEms * em);
  ImGui::BeginChild("fields", ImVec2(width, 0.0F), ImGuiChildFlags_None,
                    ImGuiWindowFlags_NoBackground);
  draw_fields(context);
  ImGui::EndChild();
  ImGui::SameLine(0.0F, kPageGapEms * em);
  ImGui::BeginChild("what happens",
                    ImVec2(std::min(ImGui::GetContentRegionAvail().x, kWidestFieldsEms * em), 0.0F),
                    ImGuiChildFlags_None, ImGuiWindowFlags_NoBackground);
  draw_what_happens(context);
  ImGui::EndChild();
}

void draw_blind_test_page(const PanelContext& context) {
  const CompareState::Transient& compare = context.state.compare.transient;
  if (blind_test_runs(context.state)) {
    draw_blind_trial(context);
  } else if (compare.test && !compare.setting_up) {
    draw_blind_result(context);
  } else {
    draw_blind_setup(context);
  }
}

}  // namespace hapticwall::ui
