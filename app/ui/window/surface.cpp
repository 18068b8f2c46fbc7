#include "app/ui/window/surface.h"

#include <epoxy/gl.h>
// GLFW comes after OpenGL's own header.
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>
#include <implot.h>

#include <string>
#include <vector>

#include "app/draw/figure/gl_objects.h"
#include "app/ui/window/application.h"

namespace hapticwall::ui {
namespace {

// GLFW calls it while the application lives.
void take_dropped_files(GLFWwindow* window, int count, const char** paths) {
  auto* application = static_cast<Application*>(glfwGetWindowUserPointer(window));
  if (application == nullptr) return;
  const std::vector<std::string> files(paths, paths + count);
  application->drop(files);
}

void take_pointer(GLFWwindow* window, double x, double y) {
  ImGui_ImplGlfw_CursorPosCallback(window, x, y);
  auto* application = static_cast<Application*>(glfwGetWindowUserPointer(window));
  if (application == nullptr) return;
  application->point({glfwGetTime(), ImVec2(static_cast<float>(x), static_cast<float>(y))});
}

ImGuiKeyChord chord_of(int mods) {
  return ((mods & GLFW_MOD_CONTROL) != 0 ? ImGuiMod_Ctrl : 0) |
         ((mods & GLFW_MOD_SHIFT) != 0 ? ImGuiMod_Shift : 0) |
         ((mods & GLFW_MOD_ALT) != 0 ? ImGuiMod_Alt : 0) |
         ((mods & GLFW_MOD_SUPER) != 0 ? ImGuiMod_Super : 0);
}

// Dear ImGui asks for the state of the modifier keys only later, when Ctrl may be released again.
void take_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
  ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, mods);
  const auto& queue = ImGui::GetCurrentContext()->InputEventsQueue;
  auto* application = static_cast<Application*>(glfwGetWindowUserPointer(window));
  if (application == nullptr || action != GLFW_PRESS || queue.empty()) return;
  application->press({queue.back().EventId, chord_of(mods)});
}

// The window was covered, and its picture is lost.
void paint_again(GLFWwindow* window) {
  auto* application = static_cast<Application*>(glfwGetWindowUserPointer(window));
  if (application != nullptr) application->forget_painted();
}

}  // namespace

Gui::Gui(GLFWwindow* window) {
  ImGui::CreateContext();
  ImPlot::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init(draw::glsl_version());
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImPlot::DestroyContext();
  ImGui::DestroyContext();
}

InputTarget::InputTarget(GLFWwindow* window, Application& application) : window_(window) {
  glfwSetWindowUserPointer(window_, &application);
  glfwSetDropCallback(window_, take_dropped_files);
  glfwSetCursorPosCallback(window_, take_pointer);
  glfwSetKeyCallback(window_, take_key);
  glfwSetWindowRefreshCallback(window_, paint_again);
}

InputTarget::~InputTarget() {
  glfwSetDropCallback(window_, nullptr);
  glfwSetWindowRefreshCallback(window_, nullptr);
  glfwSetCursorPosCallback(window_, ImGui_ImplGlfw_CursorPosCallback);
  glfwSetKeyCallback(window_, ImGui_ImplGlfw_KeyCallback);
  glfwSetWindowUserPointer(window_, nullptr);
}

void draw_frame(Application& application) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  application.frame();
  ImGui::Render();
}

void paint_frame(GLFWwindow* window) {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  glViewport(0, 0, width, height);
  const ImVec4 background = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  glClearColor(background.x, background.y, background.z, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window);
}

}  // namespace hapticwall::ui
