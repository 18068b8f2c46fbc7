// A window's worth of OpenGL and ImGui without a screen, for whoever measures frames.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/draw/figure/gl_objects.h"
#include "app/draw/plot/theme.h"
#include "core/result.h"
#include "tests/offscreen/offscreen.h"

namespace hapticwall::window_benchmark {

struct FrameCost {
  double wall_s = 0.0;
  double processor_s = 0.0;  // of all threads together, without other programs
};

class Stage {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Stage>> create(int width, int height);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage();

  // Draws and paints what `content` says; returns when the last pixel is there.
  FrameCost frame(const std::function<void()>& content);

  [[nodiscard]] const draw::Theme& theme() const { return theme_; }
  [[nodiscard]] std::string renderer() const;  // the driver's words

 private:
  Stage(std::unique_ptr<test::OffscreenContext> context, int width, int height);

  std::unique_ptr<test::OffscreenContext> context_;
  std::optional<draw::GlTarget> target_;
  draw::Theme theme_;
};

}  // namespace hapticwall::window_benchmark
