#include "app/draw/figure/page.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "app/draw/figure/gui_context.h"
#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {
namespace {

constexpr float kMaxHeight = 16384.0F;  // pixels; half of the limit of Cairo
constexpr int kFrames = 4;              // until sizes of ImGui, ImPlot and labels have settled
constexpr double kMarginMm = 1.0;
constexpr double kTickPoints = 7.0;                // em of kSmallFontSize on paper
constexpr double kInterLineEms = 3408.0 / 2816.0;  // (ascender - descender) / em

// Returns the height of the content with both margins.
float draw_frame(const Theme& theme, ImVec2 size, const DrawPage& draw) {
  const float margin = pixels_of_mm(kMarginMm);
  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(margin, margin));
  ImGui::Begin("page", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  draw(theme);
  const float bottom = ImGui::GetCursorScreenPos().y - ImGui::GetStyle().ItemSpacing.y;
  ImGui::Dummy(ImVec2());  // a moved cursor alone extends no window
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::Render();
  return std::ceil(bottom + margin);
}

Result<std::shared_ptr<const file::Shapes>> page_shapes(float width, const DrawPage& draw) {
  const ImVec2 size(width, kMaxHeight);
  const GuiContext gui(size);
  const Theme theme = shape_theme(Look::kPrint, print_scale());
  ImGui::GetStyle().ItemSpacing.y *= 0.5F;
  float height = 0.0F;
  for (int frame = 0; frame < kFrames; ++frame) {
    height = draw_frame(theme, size, draw);
    accept_textures(*ImGui::GetDrawData());
  }
  if (height > kMaxHeight) {
    return Error{ErrorKind::kUsage,
                 fmt::format("a figure of {:.0f} mm in height: it must be below {:.0f} mm; show "
                             "fewer panels, or make it wider",
                             height / pixels_of_mm(1.0), kMaxHeight / pixels_of_mm(1.0))};
  }
  ImGui::GetDrawData()->DisplaySize = ImVec2(width, height);
  return record_shapes(*ImGui::GetDrawData());
}

// Of the size of the shapes, without pixels.
file::Picture empty_picture(const file::Shapes& shapes) {
  constexpr double kInchesPerMetre = 1e3 / kMillimetresPerInch;
  file::Picture picture;
  picture.width = static_cast<int>(shapes.page.width);
  picture.height = static_cast<int>(shapes.page.height);
  picture.pixels_per_metre = static_cast<int>(std::lround(kDotsPerInch * kInchesPerMetre));
  return picture;
}

// Paints the shapes on white.
Result<file::Picture> painted(const file::Shapes& shapes) {
  file::Picture picture = empty_picture(shapes);
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, picture.height),
      cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(image.get()),
                                                               cairo_destroy);
  cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
  cairo_paint(pen.get());
  cairo_set_source_surface(pen.get(), shapes.surface, 0.0, 0.0);
  cairo_paint(pen.get());
  cairo_surface_flush(image.get());
  if (const cairo_status_t status = cairo_status(pen.get()); status != CAIRO_STATUS_SUCCESS)
    return file_error(std::string("the figure cannot be drawn: ") + cairo_status_to_string(status));
  picture.rgba = opaque_pixels(image.get());
  return picture;
}

}  // namespace

float print_scale() {
  const double line_pixels = kTickPoints * kInterLineEms * kDotsPerInch / kPointsPerInch;
  return static_cast<float>(line_pixels) / kSmallFontSize;
}

Result<file::Picture> draw_page(const Paper& paper, const DrawPage& draw) {
  if (!(paper.width_mm >= kMinWidthMm && paper.width_mm <= kMaxWidthMm)) {
    return Error{ErrorKind::kUsage,
                 fmt::format("a figure of {:g} mm in width: it takes {:g} to {:g}", paper.width_mm,
                             kMinWidthMm, kMaxWidthMm)};
  }
  auto shapes = page_shapes(std::round(pixels_of_mm(paper.width_mm)), draw);
  if (!shapes) return shapes.error();
  if (paper.ink == Ink::kPixels) return painted(**shapes);
  file::Picture picture = empty_picture(**shapes);
  picture.shapes.push_back({std::move(*shapes)});
  return picture;
}

}  // namespace hapticwall::draw
