// A printed page: ImGui and ImPlot into a picture, without a display and OpenGL.
#pragma once

#include <functional>
#include <memory>

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

// Paints picture after picture of one size. Its context of Dear ImGui is current as long as it
// lives; the fonts are opened once. Realtime-safe: no.
class PagePainter {
 public:
  // `size`, `scale`: as in draw_page(), in range.
  PagePainter(FigureSize size, float scale, Look look);
  PagePainter(const PagePainter&) = delete;
  PagePainter& operator=(const PagePainter&) = delete;
  ~PagePainter();

  // `draw` is called once; a few times for the first picture. Fails like draw_page().
  [[nodiscard]] Result<file::Picture> paint(const DrawPage& draw);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hapticwall::draw
