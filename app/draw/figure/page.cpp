#include "app/draw/figure/page.h"

#include <fmt/format.h>
#include <imgui_impl_opengl3.h>
#include <implot.h>

#include <algorithm>
#include <utility>

#include "app/draw/figure/gl_objects.h"
#include "app/draw/figure/offscreen.h"
#include "app/draw/figure/shapes.h"

namespace hapticwall::draw {
namespace {

constexpr int kMinPage = 200;    // pixels
constexpr int kMaxPage = 16384;  // the usual limit of drivers
constexpr int kFrames = 3;       // until ImGui's and ImPlot's sizes have settled
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

// The renderer of the current context.
class GlBackend {
 public:
  GlBackend() : ready_(ImGui_ImplOpenGL3_Init("#version 330 core")) {}
  GlBackend(const GlBackend&) = delete;
  GlBackend& operator=(const GlBackend&) = delete;
  ~GlBackend() {
    if (ready_) ImGui_ImplOpenGL3_Shutdown();
  }
  [[nodiscard]] bool ready() const { return ready_; }

 private:
  bool ready_;
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

Result<file::Picture> draw_pixels(FigureSize size, float scale, const DrawPage& draw) {
  const auto context = OffscreenContext::create();
  if (!context) return context.error();
  const Result<GlTarget> target = GlTarget::create(size.width, size.height, 0);
  if (!target) return target.error();
  const GuiContext gui(pixels_of(size));
  const GlBackend backend;
  if (!backend.ready()) return Error{ErrorKind::kFile, "the figure's OpenGL could not be set up"};
  const Theme theme = apply_theme(Look::kPrint, scale);
  for (int frame = 0; frame < kFrames; ++frame) {
    ImGui_ImplOpenGL3_NewFrame();
    draw_frame(theme, pixels_of(size), scale, draw);
    target->bind();
    glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
  target->resolve();
  return read_pixels(target->resolved_framebuffer(), size.width, size.height);
}

// Shapes use the measures of the glyphs and not their pixels.
void accept_textures(const ImDrawData& frame) {
  for (ImTextureData* texture : *frame.Textures) {
    const bool unused = texture->Status == ImTextureStatus_WantDestroy;
    texture->SetTexID(unused ? ImTextureID_Invalid : 1);
    texture->SetStatus(unused ? ImTextureStatus_Destroyed : ImTextureStatus_OK);
  }
}

Result<file::Picture> draw_shapes(FigureSize size, float scale, const DrawPage& draw) {
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
  auto shapes = record_shapes(*ImGui::GetDrawData());
  if (!shapes) return shapes.error();
  return file::Picture{size.width, size.height, {}, {{std::move(*shapes), 0}}};
}

}  // namespace

Result<file::Picture> draw_page(FigureSize size, float scale, const DrawPage& draw) {
  if (std::min(size.width, size.height) < kMinPage ||
      std::max(size.width, size.height) > kMaxPage) {
    return Error{ErrorKind::kUsage,
                 fmt::format("a figure of {}x{} pixels: both must be from {} to {}", size.width,
                             size.height, kMinPage, kMaxPage)};
  }
  if (size.ink == Ink::kShapes) return draw_shapes(size, scale, draw);
  return draw_pixels(size, scale, draw);
}

}  // namespace hapticwall::draw
