// Places for labels beside the marks of a plot.
#pragma once

#include <imgui.h>

#include <optional>
#include <vector>

namespace hapticwall::draw {

// In pixels; y grows downwards.
struct LabelBox {
  ImVec2 from;
  ImVec2 to;
};

// What a label must not cover (other labels, the end of the plot) and should not (lines, marks).
struct TakenPlaces {
  LabelBox area;
  std::vector<LabelBox> texts;
  std::vector<LabelBox> ink;
};

// The place beside `mark` where a text of this size covers least ink; nullopt if it covers a text
// everywhere. `above`: the preferred side.
[[nodiscard]] std::optional<LabelBox> place_label(const LabelBox& mark, ImVec2 text, bool above,
                                                  const TakenPlaces& taken);

}  // namespace hapticwall::draw
