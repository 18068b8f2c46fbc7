#include "app/ui/panel/verdict_strip.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/computed/tail.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kStripMeaning =
    "The last second, by the formulas of 'hapticwall run': verdict, way of the handle from peak to "
    "peak, mean force and its standard deviation, mean force over mean penetration, and the rhythm "
    "of what shakes. settled: within 0.1 mm and 0.3 N. buzzing: the handle rests and the force "
    "does not. oscillating: the handle moves, also when it only follows the hand.";

}  // namespace

void draw_verdict_strip(const PanelContext& context) {
  if (context.shows.hides_force) {
    ImGui::TextDisabled("verdict: hidden");
    return;
  }
  const Tail& tail = context.tails.at(shown_index(context));
  const std::string text = tail_text(tail);
  {
    const draw::FontScope font(context.theme.fonts.digits, draw::kTitleFontSize);
    const float share = ImGui::GetContentRegionAvail().x / ImGui::CalcTextSize(text.c_str()).x;
    const draw::FontScope fitting(context.theme.fonts.digits,
                                  std::clamp(std::floor(share * draw::kTitleFontSize),
                                             draw::kSmallFontSize, draw::kTitleFontSize));
    const bool on_its_way = tail.summary.verdict == Verdict::kOscillating && !tail.frequency_hz;
    const draw::Tone tone = on_its_way && tail.hand_moves
                                ? draw::Tone::kMuted
                                : draw::verdict_tone(tail.summary.verdict);
    draw::wrapped_text(context.theme.colour(tone), text);
  }
  explain(kStripMeaning);
}

}  // namespace hapticwall::ui
