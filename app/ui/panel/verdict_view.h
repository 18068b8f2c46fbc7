// The verdict of the last second: the largest text of the window, in the one colour that the wall's
// edge and the energy lamp have, too.
#pragma once

#include <optional>
#include <string>

#include "app/draw/plot/theme.h"
#include "app/draw/plot/tail.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// The verdict in a word, and the numbers that matter for it in two short lines, to two digits. The
// strip in the layouts and the tooltip have the digits of `run`: tail_text().
struct VerdictWords {
  std::string word;     // "oscillating"; "waiting" before the first sample
  std::string numbers;  // "2.8 mm at 50 Hz"; may be empty
  std::string more;     // "4.9 ± 4.4 N"; may be empty
  draw::Tone tone = draw::Tone::kMuted;
};
[[nodiscard]] VerdictWords verdict_words(const draw::Tail& tail);

// The tone of a verdict, of the wall's edge, and of a lamp that speaks; muted out of contact.
[[nodiscard]] draw::Tone tail_tone(const draw::Tail& tail);
// tail_tone() for the edge of a wall, which has its own colour out of contact.
[[nodiscard]] std::optional<draw::Tone> edge_tone(const draw::Tail& tail);

// Draws word and numbers side by side, from the cursor on. `size_px` of the word, at scale 1.
void draw_verdict_words(const draw::Theme& theme, const VerdictWords& words, float size_px);

// The verdict of the shown axis over the docked windows, with the digits of `run`. Neutral during a
// blind test and an identification.
void draw_verdict(const PanelContext& context);

// What the numbers mean, for a tooltip.
extern const char* const kVerdictMeaning;

}  // namespace hapticwall::ui
