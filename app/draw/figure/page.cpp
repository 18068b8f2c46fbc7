#include "app/draw/figure/page.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {
namespace {

constexpr int kMinPage = 200;    // pixels
constexpr int kMaxPage = 16384;  // half of the limit of Cairo
constexpr int kFrames = 3;       // frames until ImGui's and ImPlot's sizes have settled
constexpr float kFrameTimeS = 1.0F / 60.0F;
constexpr float kMargin = 24.0F;

ImVec2 pixels_of(FigureSize size) {
  return {static_cast<float>(size.width), static_cast<float>(size.height)};
}

// Own contexts of ImGui and ImPlot. The destructor restores the previous ones.
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
    io.DeltaTime = kFrameTimeS;
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

Result<std::shared_ptr<const file::Shapes>> draw_shapes(FigureSize size, float scale,
                                                        const DrawPage& draw) {
  constexpr float kRoundness = 0.03F;  // pixels between a circle and its polygon
  const GuiContext gui(pixels_of(size));
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
  const Theme theme = apply_theme(Look::kPrint, scale);
  ImGuiStyle& style = ImGui::GetStyle();
  style.AntiAliasedLines = style.AntiAliasedFill = false;
  style.CircleTessellationMaxError = kRoundness;
  for (int frame = 0; frame < kFrames; ++frame) {
    draw_frame(theme, pixels_of(size), scale, draw);
    accept_textures(*ImGui::GetDrawData());
  }
  return record_shapes(*ImGui::GetDrawData());
}

// Paints the shapes on white.
Result<file::Picture> painted(const file::Shapes& shapes, FigureSize size) {
  file::Picture picture{size.width, size.height, {}};
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height),
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
  const std::uint8_t* rows = cairo_image_surface_get_data(image.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image.get()));
  for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(size.width); ++x) {
      std::uint32_t pixel = 0;  // 0x00RRGGBB in the order of the machine
      std::memcpy(&pixel, rows + y * stride + x * sizeof pixel, sizeof pixel);
      for (const unsigned shift : {16U, 8U, 0U})
        picture.rgba.push_back(static_cast<std::uint8_t>(pixel >> shift));
      picture.rgba.push_back(0xff);
    }
  }
  return picture;
}

}  // namespace

Result<file::Picture> draw_page(FigureSize size, float scale, const DrawPage& draw) {
  if (std::min(size.width, size.height) < kMinPage ||
      std::max(size.width, size.height) > kMaxPage) {
    return Error{ErrorKind::kUsage,
                 fmt::format("a figure of {}x{} pixels: both must be from {} to {}", size.width,
                             size.height, kMinPage, kMaxPage)};
  }
  auto shapes = draw_shapes(size, scale, draw);
  if (!shapes) return shapes.error();
  if (size.ink == Ink::kPixels) return painted(**shapes, size);
  return file::Picture{size.width, size.height, {}, {{std::move(*shapes), 0}}};
}

}  // namespace hapticwall::draw
