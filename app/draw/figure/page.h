// A printed page: ImGui and ImPlot into a picture, without a display and OpenGL.
#pragma once

#include <functional>

#include "app/draw/figure/figure.h"
#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// Draws one frame of the page within its margins; called a few times for one picture.
using DrawPage = std::function<void(const Theme& theme)>;

// `scale` enlarges fonts, spacing and margin. Fails for a texture that is no glyph
// (ErrorKind::kFile) and for a size out of range (ErrorKind::kUsage).
[[nodiscard]] Result<file::Picture> draw_page(FigureSize size, float scale, const DrawPage& draw);

}  // namespace hapticwall::draw
