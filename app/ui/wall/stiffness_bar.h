// The colour bar of stiffness at the lower right of the picture, with the displayed stiffness.
#pragma once

#include <string>
#include <vector>

#include "app/ui/wall/label_pen.h"
#include "app/ui/wall/wall_measures.h"

namespace hapticwall::ui {

class StiffnessBar {
 public:
  StiffnessBar(const LabelPen& pen, const WallPicture& picture);

  // Area with its background and texts.
  [[nodiscard]] draw::PixelBox area() const;
  // False in a low picture.
  [[nodiscard]] bool has_room() const { return length_ > 3.0F * line_; }
  void draw();

 private:
  void draw_colours() const;
  void mark(double n_per_m) const;
  void write(double n_per_m, draw::Tone tone, const std::string& text);
  [[nodiscard]] float level(double n_per_m) const;

  const LabelPen& pen_;
  const WallPicture& picture_;
  StiffnessScale scale_;
  float line_;
  float length_;
  float left_;
  float right_;
  float bottom_;
  std::vector<float> taken_;  // levels of the texts
};

// "35 kN/m", "350 N/m".
[[nodiscard]] std::string stiffness_text(double n_per_m);

}  // namespace hapticwall::ui
