// A draggable bar between two parts of the window.
#pragma once

#include <cstdint>

#include "app/ui/state/ui_state.h"

namespace hapticwall::ui {

enum class SplitWay : std::uint8_t { kColumns, kRows };

struct Split {
  float moved = 0.0F;  // pixels in this frame, to the right or down
  bool reset = false;  // a double click
};

// Draws the bar in the gap that begins at `from`, with this length. Call it after both parts.
[[nodiscard]] Split draw_splitter(const PanelContext& context, const char* name, SplitWay way,
                                  ImVec2 from, float length);

// Applies a split to the first part's share of `whole` pixels. Keeps both parts visible.
void move_share(double& share, const Split& split, float whole, double usual);

}  // namespace hapticwall::ui
