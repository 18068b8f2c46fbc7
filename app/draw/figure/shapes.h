// A frame of Dear ImGui as shapes and text in the place of pixels, for vector files.
#pragma once

#include <cairo.h>
#include <imgui.h>

#include <memory>

#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::file {

// A recording in pixels of the page.
struct Shapes {
  explicit Shapes(const cairo_rectangle_t& page)
      : surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &page)) {}
  Shapes(const Shapes&) = delete;
  Shapes& operator=(const Shapes&) = delete;
  ~Shapes() { cairo_surface_destroy(surface); }

  cairo_surface_t* const surface;
};

}  // namespace hapticwall::file

namespace hapticwall::draw {

class FontFaces;

// Draws areas, lines with their weights, and text in the embedded fonts onto `page`. Preconditions:
// the frame was drawn without anti-aliasing, and its context of Dear ImGui, to which `faces`
// belong, is current. Fails (ErrorKind::kFile) for a texture that is no glyph. Realtime-safe: no.
[[nodiscard]] Failure draw_shapes(const ImDrawData& frame, FontFaces& faces, cairo_t* page);

// draw_shapes() into a recording.
[[nodiscard]] Result<std::shared_ptr<const file::Shapes>> record_shapes(const ImDrawData& frame);

}  // namespace hapticwall::draw
