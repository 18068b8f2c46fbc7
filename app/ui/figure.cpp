#include "app/ui/figure.h"

#include <fmt/format.h>
#include <imgui_impl_opengl3.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/gl_objects.h"
#include "app/ui/offscreen.h"
#include "app/ui/plot.h"
#include "app/ui/theme.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::ui {
namespace {

constexpr int kSmallestFigure = 200;     // pixels
constexpr int kLargestFigure = 16384;    // what OpenGL 3.3 drivers take, in practice
constexpr float kDesignHeight = 880.0F;  // figure of scale 1
constexpr int kFrames = 3;               // until ImGui's and ImPlot's sizes have settled
constexpr float kFrameTimeS = 1.0F / 60.0F;
constexpr float kMargin = 24.0F;
constexpr float kPrintLineWeight = 1.2F;
constexpr std::array kOrder{PlotId::kPosition, PlotId::kForce, PlotId::kStiffness,
                            PlotId::kPassivity};

// A context of ImGui and ImPlot of its own; whichever was current before is so again afterwards.
class GuiContext {
 public:
  explicit GuiContext(FigureSize size)
      : previous_(ImGui::GetCurrentContext()), previous_plot_(ImPlot::GetCurrentContext()) {
    gui_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(gui_);
    plot_ = ImPlot::CreateContext();
    ImPlot::SetCurrentContext(plot_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
    io.DeltaTime = kFrameTimeS;
    ready_ = ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  GuiContext(const GuiContext&) = delete;
  GuiContext& operator=(const GuiContext&) = delete;
  ~GuiContext() {
    if (ready_) ImGui_ImplOpenGL3_Shutdown();
    ImPlot::DestroyContext(plot_);
    ImGui::DestroyContext(gui_);
    ImGui::SetCurrentContext(previous_);
    ImPlot::SetCurrentContext(previous_plot_);
  }
  [[nodiscard]] bool ready() const { return ready_; }

 private:
  ImGuiContext* previous_;
  ImPlotContext* previous_plot_;
  ImGuiContext* gui_ = nullptr;
  ImPlotContext* plot_ = nullptr;
  bool ready_ = false;
};

// The scene in one line: what a reader needs to know how the figure came about.
std::string describe(const Scene& scene) {
  std::string text;
  for (const WallSettings& wall : scene.walls) {
    text += fmt::format("wall {:.4g} kN/m", wall.stiffness_n_per_m / 1e3);
    if (wall.damping_n_s_per_m != 0.0)
      text += fmt::format(" and {:.4g} N·s/m", wall.damping_n_s_per_m);
    text += fmt::format(" at {:.4g} mm  ·  ", wall.position_m * 1e3);
  }
  text += fmt::format("{:g} Hz  ·  handle {:.4g} g, {:.4g} N·s/m", scene.sampling.rate_hz,
                      scene.device.mass_kg * 1e3, scene.device.damping_n_s_per_m);
  if (scene.device.friction_n) text += fmt::format(", friction {:.4g} N", *scene.device.friction_n);
  if (scene.device.encoder_m)
    text += fmt::format("  ·  encoder {:.4g} mm", *scene.device.encoder_m * 1e3);
  if (scene.device.force_limit_n)
    text += fmt::format("  ·  force limit {:.4g} N", *scene.device.force_limit_n);
  return text;
}

void draw_title(const Theme& theme, const Scene& scene) {
  const auto list = algorithms();
  const bool known = scene.algorithm.index < list.size();
  ImGui::PushFont(theme.fonts.strong, kTitleFontSize);
  ImGui::Text("%s  ·  %s", scene.name.c_str(),
              known ? std::string(list[scene.algorithm.index].name).c_str() : "?");
  ImGui::PopFont();
  if (known) {
    ImGui::SameLine();
    ImGui::TextDisabled("  %s", std::string(list[scene.algorithm.index].title).c_str());
  }
  ImGui::PushFont(nullptr, kSmallFontSize);
  ImGui::TextDisabled("%s", describe(scene).c_str());
  ImGui::PopFont();
}

void draw_page(const Theme& theme, const Scene& scene, PlotSurface& surface, FigureSize size,
               float scale) {
  ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
  ImGui::SetNextWindowSize(ImVec2(static_cast<float>(size.width), static_cast<float>(size.height)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(kMargin * scale, kMargin * scale));
  ImGui::Begin("figure", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  draw_title(theme, scene);
  ImGui::Spacing();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const auto count = static_cast<float>(kOrder.size());
  const ImVec2 each(free.x, (free.y - (count - 1.0F) * gap) / count);
  for (std::size_t i = 0; i < kOrder.size(); ++i) {
    const std::string mark = fmt::format("({}) ", static_cast<char>('a' + i));
    surface.time_labels = i + 1 == kOrder.size();
    draw_plot(surface, plot_description(kOrder[i]), mark, each);
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace

Result<file::Picture> draw_figure(const Scene& scene, std::span<const Sample> samples,
                                  FigureSize size) {
  if (std::min(size.width, size.height) < kSmallestFigure ||
      std::max(size.width, size.height) > kLargestFigure) {
    return Error{ErrorKind::kUsage,
                 fmt::format("a figure of {}x{} pixels: both must be from {} to {}", size.width,
                             size.height, kSmallestFigure, kLargestFigure)};
  }
  const auto context = OffscreenContext::create();
  if (!context) return context.error();
  const Result<GlTarget> target = GlTarget::create(size.width, size.height, 0);
  if (!target) return target.error();
  const GuiContext gui(size);
  if (!gui.ready()) return Error{ErrorKind::kFile, "the figure's OpenGL could not be set up"};

  const float scale = static_cast<float>(size.height) / kDesignHeight;
  const Theme theme = apply_theme(Look::kPrint, scale);
  SampleHistory history(samples.size());
  history.push(samples);
  double from_s = samples.empty() ? 0.0 : samples.front().time_s;
  double to_s = std::max(history.newest_time_s(), from_s + scene.sampling.period_s());
  HiddenLines hidden = 0;
  Trace scratch;
  PlotSurface surface{&theme,  &history, scene.walls, &from_s, &to_s,
                      &hidden, &scratch, true,        false,   kPrintLineWeight * scale};
  for (int frame = 0; frame < kFrames; ++frame) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    draw_page(theme, scene, surface, size, scale);
    ImGui::Render();
    target->bind();
    glClearColor(1.0F, 1.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
  target->resolve();
  return read_pixels(target->resolved_framebuffer(), size.width, size.height);
}

}  // namespace hapticwall::ui
