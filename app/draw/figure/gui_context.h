// Frames of ImGui and ImPlot for shapes and text, without a window: for printed pages and films.
#pragma once

#include <cairo.h>
#include <imgui.h>
#include <implot.h>

#include <cstdint>
#include <vector>

#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

// Own contexts of ImGui and ImPlot, for shapes and not for pixels. The destructor restores the
// previous ones.
class GuiContext {
 public:
  explicit GuiContext(ImVec2 size);
  GuiContext(const GuiContext&) = delete;
  GuiContext& operator=(const GuiContext&) = delete;
  ~GuiContext();

 private:
  ImGuiContext* previous_;
  ImPlotContext* previous_plot_;
  ImGuiContext* gui_ = nullptr;
  ImPlotContext* plot_ = nullptr;
};

// A theme whose frames draw_shapes() takes.
[[nodiscard]] Theme shape_theme(Look look, float scale);

// Call it after each frame. Shapes use the measures of the glyphs and not their pixels.
void accept_textures(const ImDrawData& frame);

// RGBA, the upper row first, of an image of CAIRO_FORMAT_RGB24.
[[nodiscard]] std::vector<std::uint8_t> opaque_pixels(cairo_surface_t* image);

}  // namespace hapticwall::draw
