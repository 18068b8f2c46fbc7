// A bar between two parts of the window that can be dragged.
#pragma once

#include <cstdint>

#include "app/ui/ui_state.h"

namespace hapticwall::ui {

enum class SplitWay : std::uint8_t { kColumns, kRows };

struct Split {
  float moved = 0.0F;  // pixels in this frame, to the right or down
  bool reset = false;  // a double click
};

// In the gap (of the usual spacing) that begins at `from`, of this length; after both parts.
[[nodiscard]] Split draw_splitter(const PanelContext& context, const char* name, SplitWay way,
                                  ImVec2 from, float length);

// Applies a split to the first part's share of `whole` pixels, and leaves both parts to be seen.
void move_share(double& share, const Split& split, float whole, double usual);

}  // namespace hapticwall::ui
