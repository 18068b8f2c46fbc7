// The verdict of the last second: the largest text of the window, in the one colour that the wall's
// edge and the energy lamp have, too.
#pragma once

#include "app/draw/plot/theme.h"
#include "app/draw/verdict/verdict_words.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

// Draws word and numbers side by side, from the cursor on. `size_px` of the word, at scale 1;
// smaller where `room_px` asks for it.
void draw_verdict_words(const draw::Theme& theme, const draw::VerdictWords& words, float size_px,
                        float room_px);

// The verdict of the shown axis over the docked windows, with the digits of `run`. Neutral during a
// blind test and an identification.
void draw_verdict(const PanelContext& context);

// What the numbers mean, for a tooltip.
extern const char* const kVerdictMeaning;

}  // namespace hapticwall::ui
