// OpenGL 3.3 without a display, a window or a user's session: EGL, drawing into framebuffer
// objects.
#pragma once

#include <memory>

#include "core/result.h"

namespace hapticwall::test {

// The context is current on the thread that created it until it is destroyed there.
class OffscreenContext {
 public:
  // Fails (ErrorKind::kFile) without such an OpenGL.
  [[nodiscard]] static Result<std::unique_ptr<OffscreenContext>> create();
  virtual ~OffscreenContext() = default;
};

}  // namespace hapticwall::test
