// A printed page: ImGui and ImPlot into a picture, without a display and OpenGL.
#pragma once

#include <functional>

#include "app/draw/figure/paper.h"
#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// Draws one frame of the page within its margins, from top to bottom, and leaves the cursor below
// it; called a few times for one picture.
using DrawPage = std::function<void(const Theme& theme)>;

// The page is as high as its content. Fails for a texture that is no glyph (ErrorKind::kFile), and
// for a width out of range or a content that is too high (ErrorKind::kUsage).
[[nodiscard]] Result<file::Picture> draw_page(const Paper& paper, const DrawPage& draw);

}  // namespace hapticwall::draw
