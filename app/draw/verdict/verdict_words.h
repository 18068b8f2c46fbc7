// A verdict in a word and two short lines of numbers, for the window and for films.
#pragma once

#include <optional>
#include <string>

#include "app/draw/plot/tone.h"
#include "app/draw/verdict/tail.h"

namespace hapticwall::draw {

// The numbers that matter for the verdict, to two digits. tail_text() has the digits of `run`.
struct VerdictWords {
  std::string word;     // "oscillating"; "waiting" before the first sample
  std::string numbers;  // "2.8 mm at 50 Hz"; may be empty
  std::string more;     // "4.9 ± 4.4 N"; may be empty
  Tone tone = Tone::kMuted;
};
[[nodiscard]] VerdictWords verdict_words(const Tail& tail);

// "4.9 ± 4.4 N"; without the deviation for a good verdict. Empty out of contact.
[[nodiscard]] std::string force_words(const Tail& tail);

// The tone of a verdict, of the wall's edge, and of a lamp that speaks; muted before the first
// sample.
[[nodiscard]] Tone tail_tone(const Tail& tail);
// tail_tone() for the edge of a wall, which has its own colour while there is nothing to judge.
[[nodiscard]] std::optional<Tone> edge_tone(const Tail& tail);

}  // namespace hapticwall::draw
