#include "app/draw/figure/gui_context.h"

#include <cstddef>
#include <cstring>

namespace hapticwall::draw {

GuiContext::GuiContext(ImVec2 size)
    : previous_(ImGui::GetCurrentContext()), previous_plot_(ImPlot::GetCurrentContext()) {
  constexpr float kFrameTimeS = 1.0F / 60.0F;
  gui_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(gui_);
  plot_ = ImPlot::CreateContext();
  ImPlot::SetCurrentContext(plot_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.DisplaySize = size;
  io.DeltaTime = kFrameTimeS;
  // A figure may have more corners than a 16-bit index counts.
  io.BackendFlags |= ImGuiBackendFlags_RendererHasTextures | ImGuiBackendFlags_RendererHasVtxOffset;
}

GuiContext::~GuiContext() {
  ImPlot::DestroyContext(plot_);
  ImGui::DestroyContext(gui_);
  ImGui::SetCurrentContext(previous_);
  ImPlot::SetCurrentContext(previous_plot_);
}

Theme shape_theme(Look look, float scale) {
  constexpr float kRoundness = 0.03F;  // pixels between a circle and its polygon
  const Theme theme = apply_theme(look, scale);
  ImGuiStyle& style = ImGui::GetStyle();
  style.AntiAliasedLines = style.AntiAliasedFill = false;
  style.CircleTessellationMaxError = kRoundness;
  return theme;
}

void accept_textures(const ImDrawData& frame) {
  for (ImTextureData* texture : *frame.Textures) {
    const bool unused = texture->Status == ImTextureStatus_WantDestroy;
    texture->SetTexID(unused ? ImTextureID_Invalid : 1);
    texture->SetStatus(unused ? ImTextureStatus_Destroyed : ImTextureStatus_OK);
  }
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

}  // namespace hapticwall::draw
