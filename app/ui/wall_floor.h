// The floor that everything stands on: grid, what lies behind, and the shadows on it.
#pragma once

#include "app/ui/gl_objects.h"
#include "app/ui/theme.h"
#include "app/ui/wall_camera.h"
#include "app/ui/wall_picture.h"
#include "core/result.h"

namespace hapticwall::ui {

// Distance of grid lines and of the ruler's marks: 1, 2 or 5 times a power of ten, so that an
// extent of this length has about six to twelve of them.
[[nodiscard]] double grid_step_m(double length_m);

// Where the walls of an axis stand on the floor: x from, x to, z from, z to. Nothing where the axis
// has none.
[[nodiscard]] std::optional<glm::vec4> wall_block(const WallPicture& picture,
                                                  const WallCamera& camera, Axis axis);

class WallFloor {
 public:
  // Needs a current OpenGL 3.3 context, for its whole life. Fails with a sentence.
  [[nodiscard]] static Result<WallFloor> create();

  // All of it that does not move with the handle, into the bound target of this height in pixels,
  // over whatever was there. Depth is neither read nor written: everything else stands above.
  void draw(const WallPicture& picture, const WallCamera& camera, const Theme& theme,
            int height) const;
  // The handle's shadow, over draw().
  void draw_shadow(const WallPicture& picture, const WallCamera& camera, const Theme& theme) const;

 private:
  WallFloor(GlProgram backdrop, GlProgram floor, GlProgram shadow);
  void draw_backdrop(const WallCamera& camera, const Theme& theme, int height) const;

  GlProgram backdrop_;
  GlProgram floor_;
  GlProgram shadow_;
  GlMesh plane_;
};

}  // namespace hapticwall::ui
