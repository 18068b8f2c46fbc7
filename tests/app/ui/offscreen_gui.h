// OpenGL, Dear ImGui and ImPlot without a display.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <implot.h>

#include <memory>

#include "tests/offscreen/offscreen.h"

namespace hapticwall::test {

class OffscreenGui {
 public:
  explicit OffscreenGui(ImVec2 size) {
    auto context = test::OffscreenContext::create();
    EXPECT_TRUE(context.ok()) << context.error().message;
    if (context) context_ = std::move(*context);
    ImGui::CreateContext();
    ImPlot::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = size;
    io.DeltaTime = 1.0F / 60.0F;
    EXPECT_TRUE(ImGui_ImplOpenGL3_Init("#version 330 core"));
  }
  OffscreenGui(const OffscreenGui&) = delete;
  OffscreenGui& operator=(const OffscreenGui&) = delete;
  ~OffscreenGui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImPlot::DestroyContext();
    ImGui::DestroyContext();
  }

 private:
  std::unique_ptr<test::OffscreenContext> context_;
};

}  // namespace hapticwall::test
