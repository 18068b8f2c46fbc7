// The solids above the floor: walls, handle, its true place, the hand's intention, force. What
// moves is swept from its smallest to its largest value since the last frame.
#pragma once

#include <optional>
#include <vector>

#include "app/draw/figure/gl_objects.h"
#include "app/draw/plot/theme.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_measures.h"
#include "core/result.h"

namespace hapticwall::ui {

// The middle of a handle's ball whose tip is at a place: the ball touches a face that is there.
[[nodiscard]] glm::vec3 ball_centre(bool two_axes, const WallCamera& camera, glm::dvec2 place_m);
// Direction from the ball along the handle's rod, of length 1.
[[nodiscard]] glm::vec3 rod_direction(bool two_axes);

// Where the tip of the arrow is at the force limit; nullopt without a limit, and on two axes, whose
// arrows turn.
[[nodiscard]] std::optional<glm::vec3> limit_mark(const WallPicture& picture,
                                                  const WallCamera& camera);

// A wall in its own directions: into it, and along its face (z for the x axis, x for the y axis).
struct WallSlab {
  const PictureWall* wall = nullptr;
  float face = 0.0F;
  float end = 0.0F;  // the next wall's face, or the last wall's end
  float along_from = 0.0F;
  float along_to = 0.0F;
  float tip = 0.0F;        // position of the handle, into the wall
  float tip_along = 0.0F;  // position along the face where the handle touches
};
[[nodiscard]] WallSlab wall_slab(const WallPicture& picture, const WallCamera& camera,
                                 const PictureWall& wall);
// Slabs in the order of drawing: from the back to the front.
[[nodiscard]] std::vector<WallSlab> wall_slabs(const WallPicture& picture,
                                               const WallCamera& camera);

class WallSolids {
 public:
  // Needs a current OpenGL 3.3 context for its whole life.
  [[nodiscard]] static Result<WallSolids> create();

  // Draws into the bound target, whose depth is clear.
  void draw(const WallView& view) const;

 private:
  WallSolids(draw::GlProgram solid, draw::GlProgram wall);

  void part(const draw::GlMesh& mesh, const glm::mat4& model, const glm::vec4& colour) const;
  void rod(const draw::GlMesh& mesh, glm::vec3 from, glm::vec3 to, float radius,
           const glm::vec4& colour) const;
  void ball(glm::vec3 centre, float radius, const glm::vec4& colour) const;
  void surface(float shininess, float flatness, float shell) const;
  void draw_handle(const WallView& view) const;
  void draw_swept_handle(const WallView& view) const;
  void draw_hand(const WallView& view) const;
  void draw_true_place(const WallView& view) const;
  void draw_arrow(const WallView& view, glm::dvec2 force_n, float alpha) const;
  void draw_swept_arrow(const WallView& view) const;
  void draw_limit(const WallView& view) const;
  void draw_edges(const WallPicture& picture, const WallSlab& slab, const glm::vec4& colour) const;
  void draw_walls(const WallView& view, const std::vector<WallSlab>& slabs) const;
  void draw_slab(const WallPicture& picture, const WallSlab& slab) const;

  draw::GlProgram solid_;
  draw::GlProgram wall_;
  draw::GlMesh box_;
  draw::GlMesh sphere_;
  draw::GlMesh cylinder_;
  draw::GlMesh cone_;
  draw::GlMesh face_;
  draw::GlMesh sides_;
};

}  // namespace hapticwall::ui
