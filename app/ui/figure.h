// The figure of a run, drawn without a display (EGL, no window): position, force, stiffness,
// passivity.
#pragma once

#include <span>
#include <string>

#include "app/file/picture.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct FigureSize {
  int width = 1600;
  int height = 1200;
};

// Fails (ErrorKind::kFile) with a sentence where no off-screen OpenGL 3.3 is to be had.
[[nodiscard]] Result<file::Picture> draw_figure(const Scene& scene, std::span<const Sample> samples,
                                                FigureSize size = {});

}  // namespace hapticwall::ui
