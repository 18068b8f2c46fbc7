// The floor: grid, background and shadows.
#pragma once

#include "app/draw/figure/gl_objects.h"
#include "app/draw/plot/theme.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_measures.h"
#include "core/result.h"

namespace hapticwall::ui {

// Spacing of grid lines and ruler marks: 1, 2 or 5 times a power of ten, about six to twelve per
// extent.
[[nodiscard]] double grid_step_m(double length_m);

// Floor area of the walls of an axis: x from, x to, z from, z to. nullopt when the axis has no
// wall.
[[nodiscard]] std::optional<glm::vec4> wall_block(const WallPicture& picture,
                                                  const WallCamera& camera, Axis axis);

class WallFloor {
 public:
  // Needs a current OpenGL 3.3 context for its whole life.
  [[nodiscard]] static Result<WallFloor> create();

  // Draws the static part into the bound target of this height (pixels). Ignores and keeps the
  // depth buffer, because everything else is above the floor.
  void draw(const WallView& view, int height) const;
  // Draws the handle's shadow, after draw().
  void draw_shadow(const WallView& view) const;

 private:
  WallFloor(draw::GlProgram backdrop, draw::GlProgram floor, draw::GlProgram shadow);
  void draw_backdrop(const WallView& view, int height) const;
  void draw_blended() const;

  draw::GlProgram backdrop_;
  draw::GlProgram floor_;
  draw::GlProgram shadow_;
  draw::GlMesh plane_;
};

}  // namespace hapticwall::ui
