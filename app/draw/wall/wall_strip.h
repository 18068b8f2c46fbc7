// The magnified contact: a strip along the axis; the handle comes from the left.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "app/draw/plot/theme.h"
#include "app/draw/wall/wall_picture.h"

namespace hapticwall::draw {

// Conversion from metres along the axis to pixels.
struct Strip {
  ImVec2 from;
  ImVec2 to;
  double middle_m = 0.0;
  double span_m = 1e-3;

  [[nodiscard]] double pixels_per_m() const { return static_cast<double>(to.x - from.x) / span_m; }
  // Clamped just outside the strip.
  [[nodiscard]] float x_of(double position_m) const;
  [[nodiscard]] bool shows(double position_m) const;
  [[nodiscard]] float height() const { return to.y - from.y; }
  // The handle is drawn around this level; below `trail_from` time goes down.
  [[nodiscard]] float handle_level() const { return from.y + kHandleShare * height(); }
  [[nodiscard]] float trail_from() const { return from.y + kTrailShare * height(); }

  static constexpr float kHandleShare = 0.31F;
  static constexpr float kHandleHalf = 0.12F;  // half the handle's thickness, of the height
  static constexpr float kTrailShare = 0.50F;
};

struct StripContent {
  const WallPicture* picture = nullptr;  // along its x axis
  double face_m = 0.0;                   // face of the wall that the numbers refer to
  double measured_m = 0.0;
  std::optional<double> encoder_m;
  // False: no encoder counts, measured position and numbers, for newcomers and readers from afar.
  bool detailed = true;
};

// Walls that give way, encoder counts, handle, proxy, measured position, hand and scale bar.
void draw_strip(const Theme& theme, const Strip& strip, const StripContent& content,
                ImDrawList* list);

// A length of 1, 2 or 5 times a power of ten metres that takes up to `pixels`.
[[nodiscard]] double scale_bar_m(double pixels_per_m, double pixels);

// "0.2 mm", "5 µm".
[[nodiscard]] std::string length_text(double length_m);

}  // namespace hapticwall::draw
