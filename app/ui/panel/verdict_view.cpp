#include "app/ui/panel/verdict_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/file/text/verdict.h"
#include "app/ui/panel/identify_state.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kWordSize = 26.0F;      // pixels at scale 1, over the docked windows
constexpr float kNumbersShare = 0.42F;  // size of the numbers, of the word's
constexpr float kGapShare = 0.4F;       // gap between word and numbers, of the word's height
constexpr float kLineShare = 1.15F;     // height of a line, of its text's

// Two digits, and all digits of a larger whole number: "0.16", "2.8", "50", "1500".
std::string two_digits(double value) {
  if (std::abs(value) >= 10.0) return fmt::format("{:.0f}", value);
  return std::abs(value) >= 1.0 ? fmt::format("{:.1f}", value) : fmt::format("{:.2g}", value);
}

std::string stiffness_words(const Summary& s) {
  if (!s.displayed_stiffness_n_per_m) return {};
  const double n_per_m = *s.displayed_stiffness_n_per_m;
  if (std::abs(n_per_m) < 1e3) return two_digits(n_per_m) + " N/m";
  return two_digits(n_per_m / 1e3) + " kN/m";
}

std::string force_words(const Summary& s, bool shakes) {
  if (!s.tail_force_mean_n) return {};
  std::string text = two_digits(*s.tail_force_mean_n);
  if (shakes && s.tail_force_std_n) text += " ± " + two_digits(*s.tail_force_std_n);
  return text + " N";
}

std::string at_frequency(const draw::Tail& tail) {
  return tail.frequency_hz ? " at " + two_digits(*tail.frequency_hz) + " Hz" : std::string();
}

std::string way_words(const draw::Tail& tail) {
  const double way_mm = tail.summary.tail_peak_to_peak_m.value_or(0.0) * kMillimetresPerMetre;
  return two_digits(way_mm) + " mm" + at_frequency(tail);
}

std::string with_remark(const std::string& text, const char* remark) {
  return text.empty() ? remark : text + ", " + remark;
}

}  // namespace

const char* const kVerdictMeaning =
    "The last second, with the formulas of 'hapticwall run': verdict, peak-to-peak motion of the "
    "handle, mean force and its standard deviation, mean force over mean penetration, and the "
    "frequency of what shakes. Chatter is what the force does within 50 ms beyond a straight line, "
    "at least 0.2 s after a touch. Above 0.3 N, or a tenth of the force limit, the wall is "
    "buzzing, "
    "or oscillating if the handle swings by more than 0.1 mm. Otherwise the handle rests (settled) "
    "or moves (moving), and a wall that gives the hand more than 5 mW is called active.";

draw::Tone tail_tone(const draw::Tail& tail) {
  return tail.end_tick == 0 ? draw::Tone::kMuted : draw::verdict_tone(tail.summary.verdict);
}

std::optional<draw::Tone> edge_tone(const draw::Tail& tail) {
  const draw::Tone tone = tail_tone(tail);
  return tone == draw::Tone::kMuted ? std::nullopt : std::optional(tone);
}

VerdictWords verdict_words(const draw::Tail& tail) {
  const Summary& s = tail.summary;
  if (tail.end_tick == 0 || !s.tail_peak_to_peak_m) return {"waiting", {}, {}, draw::Tone::kMuted};
  VerdictWords words{file::verdict_text(s), stiffness_words(s), force_words(s, false),
                     tail_tone(tail)};
  switch (s.verdict) {
    case Verdict::kOscillating:
      words.numbers = way_words(tail);
      words.more = force_words(s, true);
      break;
    case Verdict::kBuzzing:
      words.more = force_words(s, true) + at_frequency(tail);
      break;
    case Verdict::kSettled:
      words.more = with_remark(words.more, "still");
      break;
    case Verdict::kActive:
      words.more = with_remark(words.more, "gives the hand energy");
      break;
    case Verdict::kMoving:
      words.more = with_remark(words.more, "the hand moves");
      break;
    case Verdict::kNoContact:
    case Verdict::kDiverged:
      words.numbers = words.more = {};
      break;
  }
  return words;
}

void draw_verdict_words(const draw::Theme& theme, const VerdictWords& words, float size_px) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushStyleColor(ImGuiCol_Text, theme.colour(words.tone));
  draw::strong_text(theme, words.word, size_px);
  ImGui::PopStyleColor();
  const ImVec2 word = ImGui::GetItemRectSize();
  const draw::FontScope font(nullptr, kNumbersShare * size_px);
  const float line = ImGui::GetTextLineHeight() * kLineShare;
  const float left = corner.x + word.x + kGapShare * word.y;
  float top = corner.y + 0.5F * word.y - (words.more.empty() ? 0.5F : 1.0F) * line;
  for (const auto& [text, tone] :
       {std::pair(&words.numbers, draw::Tone::kText), std::pair(&words.more, draw::Tone::kMuted)}) {
    if (text->empty()) continue;
    ImGui::SetCursorScreenPos(ImVec2(left, top));
    ImGui::TextColored(theme.colour(tone), "%s", text->c_str());
    top += line;
  }
}

void draw_verdict(const PanelContext& context) {
  if (context.shows.hides_force) return ImGui::TextDisabled("verdict: hidden");
  if (context.identify.experiment)
    return ImGui::TextDisabled("the experiment moves the handle: no verdict");
  const draw::Tail& tail = context.tails.at(shown_index(context));
  const VerdictWords words = verdict_words(tail);
  ImGui::BeginGroup();
  ImGui::PushStyleColor(ImGuiCol_Text, context.theme.colour(words.tone));
  draw::strong_text(context.theme, words.word, kWordSize);
  ImGui::PopStyleColor();
  if (tail.end_tick != 0) {
    const float drop = 0.5F * (ImGui::GetItemRectSize().y - ImGui::GetTextLineHeight());
    const std::string numbers = tail_numbers_text(tail);
    beside(ImGui::CalcTextSize(numbers.c_str()).x);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + drop);
    draw::wrapped_text(context.theme.colour(draw::Tone::kText), numbers);
  }
  ImGui::EndGroup();
  explain(kVerdictMeaning);
}

}  // namespace hapticwall::ui
