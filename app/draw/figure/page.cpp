#include "app/draw/figure/page.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/draw/figure/glyphs.h"
#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {

// Own contexts of ImGui and ImPlot, for shapes and not for pixels. The destructor restores the
// previous ones.
class GuiContext {
 public:
  explicit GuiContext(ImVec2 size)
      : previous_(ImGui::GetCurrentContext()), previous_plot_(ImPlot::GetCurrentContext()) {
    gui_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(gui_);
    plot_ = ImPlot::CreateContext();
    ImPlot::SetCurrentContext(plot_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.DisplaySize = size;
    io.DeltaTime = 1.0F / 60.0F;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
  }
  GuiContext(const GuiContext&) = delete;
  GuiContext& operator=(const GuiContext&) = delete;
  ~GuiContext() {
    ImPlot::DestroyContext(plot_);
    ImGui::DestroyContext(gui_);
    ImGui::SetCurrentContext(previous_);
    ImPlot::SetCurrentContext(previous_plot_);
  }

 private:
  ImGuiContext* previous_;
  ImPlotContext* previous_plot_;
  ImGuiContext* gui_ = nullptr;
  ImPlotContext* plot_ = nullptr;
};

namespace {

constexpr int kMinPage = 200;    // pixels
constexpr int kMaxPage = 16384;  // half of the limit of Cairo
constexpr int kFrames = 3;       // frames until ImGui's and ImPlot's sizes have settled
constexpr float kMargin = 24.0F;

ImVec2 pixels_of(FigureSize size) {
  return {static_cast<float>(size.width), static_cast<float>(size.height)};
}

void draw_frame(const Theme& theme, ImVec2 size, float scale, const DrawPage& draw) {
  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(kMargin * scale, kMargin * scale));
  ImGui::Begin("page", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  draw(theme);
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::Render();
}

// Shapes use the measures of the glyphs and not their pixels.
void accept_textures(const ImDrawData& frame) {
  for (ImTextureData* texture : *frame.Textures) {
    const bool unused = texture->Status == ImTextureStatus_WantDestroy;
    texture->SetTexID(unused ? ImTextureID_Invalid : 1);
    texture->SetStatus(unused ? ImTextureStatus_Destroyed : ImTextureStatus_OK);
  }
}

// A theme whose frames draw_shapes() takes.
Theme shape_theme(Look look, float scale) {
  constexpr float kRoundness = 0.03F;  // pixels between a circle and its polygon
  const Theme theme = apply_theme(look, scale);
  ImGuiStyle& style = ImGui::GetStyle();
  style.AntiAliasedLines = style.AntiAliasedFill = false;
  style.CircleTessellationMaxError = kRoundness;
  return theme;
}

void draw_frames(const Theme& theme, FigureSize size, float scale, int count,
                 const DrawPage& draw) {
  for (int frame = 0; frame < count; ++frame) {
    draw_frame(theme, pixels_of(size), scale, draw);
    accept_textures(*ImGui::GetDrawData());
  }
}

Result<std::shared_ptr<const file::Shapes>> page_shapes(FigureSize size, float scale,
                                                        const DrawPage& draw) {
  const GuiContext gui(pixels_of(size));
  const Theme theme = shape_theme(Look::kPrint, scale);
  draw_frames(theme, size, scale, kFrames, draw);
  return record_shapes(*ImGui::GetDrawData());
}

std::vector<std::uint8_t> opaque_pixels(cairo_surface_t* image) {
  constexpr std::size_t kBytesPerPixel = 4;
  const std::uint8_t* rows = cairo_image_surface_get_data(image);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image));
  const auto width = static_cast<std::size_t>(cairo_image_surface_get_width(image));
  const auto height = static_cast<std::size_t>(cairo_image_surface_get_height(image));
  std::vector<std::uint8_t> rgba(kBytesPerPixel * width * height);
  std::uint8_t* to = rgba.data();
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      std::uint32_t pixel = 0;  // 0x00RRGGBB in the order of the machine
      std::memcpy(&pixel, rows + y * stride + x * sizeof pixel, sizeof pixel);
      for (const unsigned shift : {16U, 8U, 0U}) *to++ = static_cast<std::uint8_t>(pixel >> shift);
      *to++ = 0xff;
    }
  }
  return rgba;
}

// Paints what `draw` draws, on this colour.
Result<file::Picture> painted(FigureSize size, const ImVec4& background,
                              const std::function<Failure(cairo_t* pen)>& draw) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height),
      cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(image.get()),
                                                               cairo_destroy);
  cairo_set_source_rgb(pen.get(), background.x, background.y, background.z);
  cairo_paint(pen.get());
  if (Failure failed = draw(pen.get())) return *failed;
  cairo_surface_flush(image.get());
  if (const cairo_status_t status = cairo_status(pen.get()); status != CAIRO_STATUS_SUCCESS)
    return file_error(std::string("the figure cannot be drawn: ") + cairo_status_to_string(status));
  return file::Picture{size.width, size.height, opaque_pixels(image.get())};
}

// The shapes on white.
Result<file::Picture> painted(const file::Shapes& shapes, FigureSize size) {
  return painted(size, ImVec4(1.0F, 1.0F, 1.0F, 1.0F), [&](cairo_t* pen) {
    cairo_set_source_surface(pen, shapes.surface, 0.0, 0.0);
    cairo_paint(pen);
    return Failure();
  });
}

}  // namespace

Result<file::Picture> draw_page(FigureSize size, float scale, const DrawPage& draw) {
  if (std::min(size.width, size.height) < kMinPage ||
      std::max(size.width, size.height) > kMaxPage) {
    return Error{ErrorKind::kUsage,
                 fmt::format("a figure of {}x{} pixels: both must be from {} to {}", size.width,
                             size.height, kMinPage, kMaxPage)};
  }
  auto shapes = page_shapes(size, scale, draw);
  if (!shapes) return shapes.error();
  if (size.ink == Ink::kPixels) return painted(**shapes, size);
  return file::Picture{size.width, size.height, {}, {{std::move(*shapes), 0}}};
}

struct PagePainter::Parts {
  FigureSize size;
  float scale;
  GuiContext gui{pixels_of(size)};
  Theme theme{};
  FontFaces faces{};
  bool settled = false;
};

PagePainter::PagePainter(FigureSize size, float scale, Look look)
    : parts_(new Parts{.size = size, .scale = scale}) {
  parts_->theme = shape_theme(look, scale);
  ImGui::GetStyle().Colors[ImGuiCol_WindowBg] = parts_->theme.colour(Tone::kBackground);
}

PagePainter::~PagePainter() = default;

Result<file::Picture> PagePainter::paint(const DrawPage& draw) {
  draw_frames(parts_->theme, parts_->size, parts_->scale, parts_->settled ? 1 : kFrames, draw);
  parts_->settled = true;
  return painted(parts_->size, parts_->theme.colour(Tone::kBackground), [&](cairo_t* pen) {
    return draw_shapes(*ImGui::GetDrawData(), parts_->faces, pen);
  });
}

}  // namespace hapticwall::draw
