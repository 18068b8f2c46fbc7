#include "app/draw/figure/figure_file.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {
namespace {

constexpr double kPointsPerPixel = points_of_pixels(1.0);

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* new_page(const file::Picture& figure, bool pdf, std::string& bytes) {
  const double width = kPointsPerPixel * figure.width;
  const double height = kPointsPerPixel * figure.height;
  if (!pdf) return cairo_svg_surface_create_for_stream(append, &bytes, width, height);
  cairo_surface_t* page = cairo_pdf_surface_create_for_stream(append, &bytes, width, height);
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_CREATE_DATE, "");
  return page;
}

Result<std::string> encode_shapes(const file::Picture& figure, bool pdf) {
  std::string bytes;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> page(
      new_page(figure, pdf, bytes), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(page.get()),
                                                               cairo_destroy);
  cairo_scale(pen.get(), kPointsPerPixel, kPointsPerPixel);
  // Beside a part that is smaller than the page.
  cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
  if (figure.shapes.size() > 1) cairo_paint(pen.get());
  for (const file::PlacedShapes& part : figure.shapes) {
    cairo_set_source_surface(pen.get(), part.shapes->surface, part.left, part.top);
    cairo_paint(pen.get());
  }
  cairo_surface_finish(page.get());
  const cairo_status_t status = std::max(cairo_status(pen.get()), cairo_surface_status(page.get()));
  if (status == CAIRO_STATUS_SUCCESS) return bytes;
  return file_error(std::string("the figure cannot be encoded: ") + cairo_status_to_string(status));
}

}  // namespace

Ink ink_of(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".svg" || ending == ".pdf" ? Ink::kShapes : Ink::kPixels;
}

Result<std::string> encode_figure(const file::Picture& figure, const std::string& path) {
  if (ink_of(path) == Ink::kPixels) return file::encode_png(figure);
  return encode_shapes(figure, ending_of(path) == ".pdf");
}

}  // namespace hapticwall::draw
