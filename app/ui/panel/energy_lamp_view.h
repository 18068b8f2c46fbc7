// The energy lamp: tell_energy_story() as a light and as text.
#pragma once

#include <string>

#include "app/ui/state/panel_context.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

// Texts from the longest to the shortest; the longest that fits is drawn.
struct LampWords {
  draw::Tone tone = draw::Tone::kGood;
  std::string text;    // "active: the hand has extracted 12.3 mJ, the hold to blame"
  std::string remark;  // view of the other observer; may be empty
  std::string shorter;
  std::string shortest;
};
[[nodiscard]] LampWords lamp_words(const EnergyStory& story);

// Explains the computation with the values of the story. `since_s`: start of the story.
[[nodiscard]] std::string lamp_tooltip(const EnergyStory& story, double since_s);

// Draws one line of text from the cursor to the right edge. Neutral during a blind test.
void draw_energy_lamp(const PanelContext& context);

}  // namespace hapticwall::ui
