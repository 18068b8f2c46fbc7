#include "app/draw/figure/page_painter.h"

#include <cairo.h>

#include <string>

#include "app/draw/figure/glyphs.h"
#include "app/draw/figure/gui_context.h"
#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {
namespace {

constexpr int kSettlingFrames = 3;       // until ImGui's and ImPlot's sizes have settled
constexpr float kPictureMargin = 24.0F;  // pixels at scale 1

ImVec2 pixels_of(PictureSize size) {
  return {static_cast<float>(size.width), static_cast<float>(size.height)};
}

}  // namespace

struct PagePainter::Parts {
  PictureSize size;
  float scale;
  GuiContext gui{pixels_of(size)};
  Theme theme{};
  FontFaces faces{};
  bool settled = false;

  void draw_frame(const DrawPage& draw) const;
};

void PagePainter::Parts::draw_frame(const DrawPage& draw) const {
  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
  ImGui::SetNextWindowSize(pixels_of(size));
  const float margin = kPictureMargin * scale;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(margin, margin));
  ImGui::Begin("picture", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  draw(theme);
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::Render();
  accept_textures(*ImGui::GetDrawData());
}

PagePainter::PagePainter(PictureSize size, float scale, Look look)
    : parts_(new Parts{.size = size, .scale = scale}) {
  parts_->theme = shape_theme(look, scale);
  ImGui::GetStyle().Colors[ImGuiCol_WindowBg] = parts_->theme.colour(Tone::kBackground);
}

PagePainter::~PagePainter() = default;

Result<file::Picture> PagePainter::paint(const DrawPage& draw) {
  for (int frame = parts_->settled ? 1 : kSettlingFrames; frame > 0; --frame)
    parts_->draw_frame(draw);
  parts_->settled = true;
  const auto& [width, height] = parts_->size;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(image.get()),
                                                               cairo_destroy);
  const ImVec4& ground = parts_->theme.colour(Tone::kBackground);
  cairo_set_source_rgb(pen.get(), ground.x, ground.y, ground.z);
  cairo_paint(pen.get());
  if (Failure failed = draw_shapes(*ImGui::GetDrawData(), parts_->faces, nullptr, pen.get()))
    return *failed;
  cairo_surface_flush(image.get());
  if (const cairo_status_t status = cairo_status(pen.get()); status != CAIRO_STATUS_SUCCESS)
    return file_error(std::string("the picture cannot be drawn: ") +
                      cairo_status_to_string(status));
  return file::Picture{width, height, opaque_pixels(image.get())};
}

}  // namespace hapticwall::draw
