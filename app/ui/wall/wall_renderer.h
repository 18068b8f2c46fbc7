// Draws a WallPicture with shaders, and again only when it looks different.
#pragma once

#include <cstdint>
#include <memory>

#include "app/draw/figure/gl_objects.h"
#include "app/draw/plot/theme.h"
#include "app/ui/wall/wall_camera.h"
#include "app/ui/wall/wall_measures.h"
#include "core/result.h"

namespace hapticwall::ui {

class WallRenderer {
 public:
  // Needs a current OpenGL 3.3 context for its whole life.
  [[nodiscard]] static Result<std::unique_ptr<WallRenderer>> create();
  virtual ~WallRenderer() = default;
  // A renderer of another picture with the same shaders and shapes.
  [[nodiscard]] virtual std::unique_ptr<WallRenderer> another() const = 0;

  // Returns the texture of a picture of this size in pixels, upside down as usual in OpenGL; 0 if
  // the driver refuses the size. Draws when something has changed by more than an eighth of a
  // pixel or a shade. Without a graphics card a moving picture is a draft (one sample a pixel), and
  // is refined after some calls without a change. Binds the default framebuffer afterwards.
  virtual GLuint draw(const WallPicture& picture, const WallCamera& camera,
                      const draw::Theme& theme, int width, int height) = 0;
  // A moving picture gets this share of width and height, in (0, 1]; a still one all of it.
  virtual void set_draft_share(float share) = 0;
  // False: the picture is a draft, to be refined by further calls.
  [[nodiscard]] virtual bool refined() const = 0;
  // Number of calls of draw() that have drawn.
  [[nodiscard]] virtual std::uint64_t times_drawn() const = 0;
  // The framebuffer that holds the last picture, to be read.
  [[nodiscard]] virtual GLuint framebuffer() const = 0;
};

// The picture rounded to steps that the eye cannot see; `step_m` is the step of places.
[[nodiscard]] WallPicture in_visible_steps(const WallPicture& picture, double step_m);

}  // namespace hapticwall::ui
