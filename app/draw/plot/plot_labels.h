// Places for labels in a plot where no trace and no other label is.
#pragma once

#include <imgui.h>

#include <optional>
#include <span>
#include <vector>

namespace hapticwall::draw {

// Opacity of the background behind labels that stand on a picture.
inline constexpr float kBehindText = 0.72F;

// Box in pixels; y grows downwards.
struct PixelBox {
  ImVec2 from;
  ImVec2 to;

  [[nodiscard]] bool touches(const PixelBox& other) const {
    return from.x < other.to.x && other.from.x < to.x && from.y < other.to.y && other.from.y < to.y;
  }
};

// The end of a line, near which its label should stand.
struct LineEnd {
  const char* label = "";
  ImU32 colour = 0;
  ImVec2 place;
};

// Areas and line ends that a plot has drawn so far in this frame.
struct PlotInk {
  std::vector<PixelBox> taken;
  std::vector<LineEnd> ends;

  void clear();
  // A piece of a trace, in the order in which it is drawn.
  void take(const PixelBox& box);
  // The line through the points, in pixels.
  void take(std::span<const ImVec2> points, float weight);
};

// The first of `corners` at which a label of this size lies within `area` and covers nothing;
// nullopt if there is none. Marks the place as taken.
[[nodiscard]] std::optional<ImVec2> take_free_place(PlotInk& ink, const PixelBox& area, ImVec2 size,
                                                    std::span<const ImVec2> corners);

// The names of the lines beside their ends, in their colours. A name without a free place is left
// to the legend.
void draw_line_ends(PlotInk& ink, const PixelBox& area, ImDrawList* list);

}  // namespace hapticwall::draw
