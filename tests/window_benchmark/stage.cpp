#include "tests/window_benchmark/stage.h"

#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <implot.h>

#include <chrono>
#include <ctime>
#include <utility>

namespace hapticwall::window_benchmark {

Result<std::unique_ptr<Stage>> Stage::create(int width, int height) {
  auto context = test::OffscreenContext::create();
  if (!context) return context.error();
  auto target = draw::GlTarget::create(width, height, 0);
  if (!target) return target.error();
  std::unique_ptr<Stage> stage(new Stage(std::move(*context), width, height));
  stage->target_ = std::move(*target);
  return stage;
}

Stage::Stage(std::unique_ptr<test::OffscreenContext> context, int width, int height)
    : context_(std::move(context)) {
  ImGui::CreateContext();
  ImPlot::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = 1.0F / 60.0F;
  ImGui_ImplOpenGL3_Init("#version 330 core");
  theme_ = draw::apply_theme(draw::Look::kScreen, 1.0F);
}

Stage::~Stage() {
  target_.reset();
  ImGui_ImplOpenGL3_Shutdown();
  ImPlot::DestroyContext();
  ImGui::DestroyContext();
}

FrameCost Stage::frame(const std::function<void()>& content) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  content();
  ImGui::Render();
  target_->bind();
  const ImVec4 background = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  glClearColor(background.x, background.y, background.z, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glFinish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {wall.count(), static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC};
}

std::string Stage::renderer() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "unknown" : reinterpret_cast<const char*>(name);
}

}  // namespace hapticwall::window_benchmark
