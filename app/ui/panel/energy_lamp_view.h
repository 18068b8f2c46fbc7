// The energy lamp: what tell_energy_story() says, as a light and as words.
#pragma once

#include <string>

#include "app/ui/ui_state.h"
#include "core/energy_story.h"

namespace hapticwall::ui {

// The same from the longest to the shortest: whichever there is room for.
struct LampWords {
  Tone tone = Tone::kGood;
  std::string text;    // "active: the hand has extracted 12.3 mJ, the hold to blame"
  std::string remark;  // what the other one of the two has to say to it; may be empty
  std::string shorter;
  std::string shortest;
};
[[nodiscard]] LampWords lamp_words(const EnergyStory& story);

// How it is computed, with the figures of the story; `since_s`: where it begins.
[[nodiscard]] std::string lamp_tooltip(const EnergyStory& story, double since_s);

// From the cursor to the right edge, one line of text high. Neutral while a blind test runs.
void draw_energy_lamp(const PanelContext& context);

}  // namespace hapticwall::ui
