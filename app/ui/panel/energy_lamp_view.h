// The energy lamp: tell_energy_story() as a light and as text.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

// Texts from the longest to the shortest; the longest that fits is drawn.
struct LampWords {
  std::string text;    // "the hand has extracted 12.3 mJ, the hold to blame"
  std::string remark;  // view of the other observer; may be empty
  std::string shorter;
  std::string shortest;
};
[[nodiscard]] LampWords lamp_words(const EnergyStory& story);

// The tone of the verdict when the hand has extracted energy and the verdict is no good one; muted
// otherwise, because a contact that has come to rest needs no alarm.
[[nodiscard]] draw::Tone lamp_tone(const EnergyStory& story, const draw::Tail& tail);

// A sentence without the terms of the paper: "The hold has fed the hand 0.51 J." Precondition: the
// hand has extracted energy.
[[nodiscard]] std::string plain_sentence(const EnergyStory& story);

// Explains the computation with the values of the story. `since_s`: start of the story.
[[nodiscard]] std::string lamp_tooltip(const EnergyStory& story, double since_s);

// Draws one line of text from the cursor to the right edge. Neutral during a blind test; a dark
// light without words out of contact and during an identification.
void draw_energy_lamp(const PanelContext& context);

}  // namespace hapticwall::ui
