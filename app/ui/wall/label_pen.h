// Writes labels over the picture of the wall. A label that would meet an earlier one is left out.
#pragma once

#include <imgui.h>

#include <initializer_list>
#include <span>
#include <string>

#include "app/draw/plot/plot_labels.h"
#include "app/draw/plot/theme.h"
#include "app/ui/wall/wall_camera.h"

namespace hapticwall::ui {

// An area of the window, in pixels.
struct ViewArea {
  ImVec2 corner;
  ImVec2 size;
};

struct Label {
  ImVec2 place;  // position of its middle; it is kept inside the picture
  draw::Tone tone;
  std::string text;
  // The line to its object, if the two differ.
  ImVec2 thing = place;
  ImVec2 line_to = place;
};

// Places in the picture's units become pixels of the window.
class LabelPen {
 public:
  // `taken`: areas that no label may cover.
  LabelPen(const draw::Theme& theme, const WallCamera& camera, const ViewArea& area,
           std::span<const draw::PixelBox> taken);

  [[nodiscard]] ImVec2 screen(glm::vec3 point) const;
  [[nodiscard]] bool within(ImVec2 place) const;
  [[nodiscard]] bool is_free(const draw::PixelBox& box) const;
  void take(const draw::PixelBox& box) { ink_.taken.push_back(box); }
  // Writes the label, moved by the first shift that finds it a free area. False: none does.
  bool write(const Label& label, std::initializer_list<ImVec2> shifts = {ImVec2()});
  void line(ImVec2 from, ImVec2 to, draw::Tone tone, float alpha = 1.0F) const;
  [[nodiscard]] const draw::Theme& theme() const { return theme_; }
  [[nodiscard]] ImDrawList* list() const { return list_; }
  [[nodiscard]] const ViewArea& area() const { return area_; }

 private:
  const draw::Theme& theme_;
  const WallCamera& camera_;
  const ViewArea& area_;
  draw::PlotInk ink_;
  ImDrawList* list_;
};

}  // namespace hapticwall::ui
