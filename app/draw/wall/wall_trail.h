// The recent way of the handle, below the magnified contact.
#pragma once

#include <imgui.h>

#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"
#include "app/draw/wall/wall_strip.h"

namespace hapticwall::draw {

inline constexpr double kTrailS = 0.25;  // length of the handle's trail, shown below it

struct StripTrail {
  const SampleHistory& history;
  double newest_s = 0.0;
  bool with_measured = true;
};

// True and measured position in the kTrailS before `newest_s`, the newest at the top, fading.
// `scratch` is overwritten.
void draw_trail(const Theme& theme, const Strip& strip, const StripTrail& trail, Trace& scratch,
                ImDrawList* list);

}  // namespace hapticwall::draw
