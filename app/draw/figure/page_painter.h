// Paints picture after picture of one size, for films.
#pragma once

#include <memory>

#include "app/draw/figure/page.h"
#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// In pixels.
struct PictureSize {
  int width = 0;
  int height = 0;
};

// Its context of Dear ImGui is current as long as it lives; the fonts are opened once.
// Realtime-safe: no.
class PagePainter {
 public:
  // `scale` enlarges fonts, spacing and margin.
  PagePainter(PictureSize size, float scale, Look look);
  PagePainter(const PagePainter&) = delete;
  PagePainter& operator=(const PagePainter&) = delete;
  ~PagePainter();

  // `draw` is called once; a few times for the first picture. Fails for a texture that is no glyph
  // (ErrorKind::kFile).
  [[nodiscard]] Result<file::Picture> paint(const DrawPage& draw);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hapticwall::draw
