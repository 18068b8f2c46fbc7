#include "app/ui/panel/verdict_view.h"

#include <algorithm>
#include <utility>

#include "app/ui/panel/identify_state.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kWordSize = 26.0F;      // pixels at scale 1, over the docked windows
constexpr float kNumbersShare = 0.42F;  // size of the numbers, of the word's
constexpr float kGapShare = 0.4F;       // gap between word and numbers, of the word's height
constexpr float kLineShare = 1.15F;     // height of a line, of its text's

// Width of word, gap and the longer line of numbers.
float words_width(const draw::Theme& theme, const draw::VerdictWords& words, float size_px) {
  float width = 0.0F;
  {
    const draw::FontScope font(theme.fonts.strong, size_px);
    const ImVec2 word = ImGui::CalcTextSize(words.word.c_str());
    width = word.x + kGapShare * word.y;
  }
  const draw::FontScope font(nullptr, kNumbersShare * size_px);
  return width + std::max(ImGui::CalcTextSize(words.numbers.c_str()).x,
                          ImGui::CalcTextSize(words.more.c_str()).x);
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

void draw_verdict_words(const draw::Theme& theme, const draw::VerdictWords& words, float size_px,
                        float room_px) {
  size_px *= std::min(1.0F, room_px / std::max(words_width(theme, words, size_px), 1.0F));
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
  const draw::VerdictWords words = verdict_words(tail);
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
  point_at(context, TourPlace::kVerdict);
  explain(kVerdictMeaning);
}

}  // namespace hapticwall::ui
