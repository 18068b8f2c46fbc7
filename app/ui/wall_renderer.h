// Draws the virtual wall, the handle, the hand's intention and the force, with our own shaders.
#pragma once

#include <imgui.h>

#include <memory>
#include <optional>
#include <vector>

#include "app/ui/gl_objects.h"
#include "app/ui/theme.h"
#include "app/ui/wall_camera.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::ui {

// What there is to be seen, metres and newtons. The tip of the handle is its position.
struct WallPicture {
  double handle_m = 0.0;
  std::optional<double> hand_m;
  std::vector<double> wall_faces_m;  // ascending
  double force_n = 0.0;              // F_d; positive pushes out of the wall
  double full_scale_n = 10.0;        // the force with the longest arrow
  bool saturated = false;
  bool in_contact = false;
};

[[nodiscard]] WallPicture wall_picture(const Scene& scene, const Sample& sample);

// Measures in the picture's units, shared with whoever writes labels beside things.
struct WallMeasures {
  static constexpr float kHandleRadius = 0.42F;
  static constexpr float kHandleLength = 2.7F;
  static constexpr float kArrowHeight = 0.95F;  // of the arrow above the axis
  static constexpr float kLongestArrow = 3.4F;
  static constexpr float kFloor = -1.25F;
  static constexpr float kWallTop = 1.65F;
  static constexpr float kWallHalfDepth = 1.5F;
};

// Length of the force arrow in the picture's units; positive points into the wall.
[[nodiscard]] float arrow_length(const WallPicture& picture);

class WallRenderer {
 public:
  // Needs a current OpenGL 3.3 context, for its whole life. Fails with a sentence.
  [[nodiscard]] static Result<std::unique_ptr<WallRenderer>> create();
  virtual ~WallRenderer() = default;

  // Draws into a picture of this size in pixels and returns its texture, upside down as OpenGL has
  // it; 0 where the driver refuses the size. The default framebuffer is bound afterwards.
  virtual GLuint draw(const WallPicture& picture, const WallCamera& camera, const Theme& theme,
                      int width, int height) = 0;
  // The framebuffer that holds the last picture, to be read.
  [[nodiscard]] virtual GLuint framebuffer() const = 0;
};

}  // namespace hapticwall::ui
