// A frame of Dear ImGui as shapes and text in the place of pixels, for vector files.
#pragma once

#include <cairo.h>
#include <imgui.h>

#include <memory>
#include <string>
#include <vector>

#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::file {

// A piece of text on the page, in pixels.
struct DrawnText {
  std::string text;
  double em = 0.0;
  cairo_rectangle_t ink{};   // the smallest box around its glyphs
  cairo_rectangle_t clip{};  // nothing is drawn beyond it
};

// A recording in pixels of the page.
struct Shapes {
  explicit Shapes(const cairo_rectangle_t& extents)
      : page(extents),
        surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents)) {}
  Shapes(const Shapes&) = delete;
  Shapes& operator=(const Shapes&) = delete;
  ~Shapes() { cairo_surface_destroy(surface); }

  cairo_rectangle_t page;
  cairo_surface_t* const surface;
  std::vector<DrawnText> texts;  // in the order of drawing
};

}  // namespace hapticwall::file

namespace hapticwall::draw {

class FontFaces;

// Draws areas, lines with their weights, and text in the embedded fonts onto `page`. Preconditions:
// the frame was drawn without anti-aliasing, and its context of Dear ImGui, to which `faces`
// belong, is current. `texts`, unless null, receives the texts. Fails (ErrorKind::kFile) for a
// texture that is no glyph. Realtime-safe: no.
[[nodiscard]] Failure draw_shapes(const ImDrawData& frame, FontFaces& faces,
                                  std::vector<file::DrawnText>* texts, cairo_t* page);

// draw_shapes() into a recording.
[[nodiscard]] Result<std::shared_ptr<const file::Shapes>> record_shapes(const ImDrawData& frame);

}  // namespace hapticwall::draw
