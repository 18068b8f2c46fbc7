// An application on a fake session, drawn off-screen and used with pointer and keys. Time passes
// only by frames.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>
#include <implot.h>

#include <memory>
#include <optional>
#include <string>

#include "app/draw/figure/gl_objects.h"
#include "app/draw/figure/offscreen.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/window/application.h"
#include "tests/app/ui/fake_session.h"
#include "tests/app/ui/items.h"

namespace hapticwall::test {

inline constexpr int kScreenWidth = 1280;
inline constexpr int kScreenHeight = 1160;  // the whole control panel, with a section open

class GuiTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = draw::OffscreenContext::create();
    ASSERT_TRUE(context.ok()) << context.error().message;
    context_ = std::move(*context);
    ImGui::CreateContext();
    ImPlot::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = ImVec2(kScreenWidth, kScreenHeight);
    io.DeltaTime = 1.0F / 60.0F;
    ASSERT_TRUE(ImGui_ImplOpenGL3_Init("#version 330 core"));
    auto target = draw::GlTarget::create(kScreenWidth, kScreenHeight, 0);
    ASSERT_TRUE(target.ok());
    target_ = std::move(*target);
    open("press");
  }

  void TearDown() override {
    application_.reset();
    target_.reset();
    ImGui_ImplOpenGL3_Shutdown();
    ImPlot::DestroyContext();
    ImGui::DestroyContext();
    context_.reset();
  }

  void open(const std::string& scene_name) {
    const auto start = [this](const Scene& scene) -> Result<std::unique_ptr<runtime::LiveSession>> {
      if (!refuse_session.empty()) return Error{ErrorKind::kDevice, refuse_session};
      auto session = std::make_unique<FakeSession>(scene);
      fake_ = session.get();
      ++sessions;
      return std::unique_ptr<runtime::LiveSession>(std::move(session));
    };
    ui::Application::Sessions starters;
    starters.simulate = start;
    starters.open_recording = open_recording;
    if (with_device) {
      starters.start_on_device = [this, start](const Scene& scene) {
        EXPECT_EQ(devices_open, 0) << "there is one device only";
        if (!refuse_device.empty()) {
          return Result<std::unique_ptr<runtime::LiveSession>>(
              Error{ErrorKind::kDevice, refuse_device});
        }
        auto session = start(scene);
        if (session) {
          fake_->info = {"paddle", false};
          fake_->arming.state = runtime::ArmingState::kOff;
          ++devices_open;
          fake_->open_count = &devices_open;
        }
        return session;
      };
    }
    const draw::Theme theme = draw::apply_theme(draw::Look::kScreen, 1.0F);
    auto application =
        ui::Application::create(file::load_scene(scene_name)->scene, options, theme, starters);
    ASSERT_TRUE(application.ok()) << application.error().message;
    application_ = std::move(*application);
    frames(3);
  }

  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      ImGui_ImplOpenGL3_NewFrame();
      watch_items();
      ImGui::NewFrame();
      application_->frame();
      ImGui::Render();
    }
  }

  // Paints only when the test needs pixels, because painting is slow without a graphics card.
  file::Picture screen() {
    frames(1);
    target_->bind();
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    target_->resolve();
    return draw::read_pixels(target_->resolved_framebuffer(), kScreenWidth, kScreenHeight);
  }

  // All text of the window in one frame, from top to bottom, including scrolled parts.
  std::string text() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImGui::LogToBuffer(0);
    application_->frame();
    std::string text = ImGui::GetCurrentContext()->LogBuffer.c_str();
    ImGui::LogFinish();
    ImGui::Render();
    return text;
  }

  // Advances the session, with a frame now and then.
  void live(int ticks) {
    constexpr int kTicksPerFrame = 100;
    for (int done = 0; done < ticks; done += kTicksPerFrame) {
      fake_->advance(std::min(kTicksPerFrame, ticks - done));
      frames(1);
    }
  }

  void press(ImGuiKey key) {
    ImGui::GetIO().AddKeyEvent(key, true);
    frames(2);
    ImGui::GetIO().AddKeyEvent(key, false);
    frames(2);
  }

  void move_to(ImVec2 place) {
    ImGui::GetIO().AddMousePosEvent(place.x, place.y);
    frames(2);
  }
  void mouse_button(bool down) {
    ImGui::GetIO().AddMouseButtonEvent(ImGuiMouseButton_Left, down);
    frames(2);
  }

  [[nodiscard]] static std::optional<ItemRect> find(const std::string& item) {
    return find_item(item);
  }
  [[nodiscard]] static ItemRect rect(const std::string& item) {
    const auto found = find(item);
    EXPECT_TRUE(found.has_value()) << item;
    return found.value_or(ItemRect{});
  }

  void click(const std::string& item) {
    move_to(rect(item).centre());
    mouse_button(true);
    mouse_button(false);
  }

  // Scrolls the area under an item to its end.
  void scroll_down_at(const std::string& item) {
    constexpr float kFar = -100.0F;
    move_to(rect(item).centre());
    ImGui::GetIO().AddMouseWheelEvent(0.0F, kFar);
    frames(5);
  }

  // Types into a field and confirms with Enter.
  void type(const std::string& item, const std::string& text) {
    click(item);
    for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    frames(3);
    press(ImGuiKey_Enter);
  }

  // The newest message; kind kNone without one.
  [[nodiscard]] ui::Message message() const {
    return application_->state().transient.toasts.newest();
  }

  [[nodiscard]] const std::optional<ui::Refusal>& refusal() const {
    return application_->state().transient.refusal;
  }

  std::string refuse_session;        // the error of the next sessions
  std::string refuse_device;         // of those on the device alone
  ui::Application::Options options;  // of the next open()
  ui::Application::RecordingOpener open_recording;
  int sessions = 0;
  bool with_device = false;  // the next open() is on a real one
  int devices_open = 0;
  std::unique_ptr<draw::OffscreenContext> context_;
  std::optional<draw::GlTarget> target_;
  std::unique_ptr<ui::Application> application_;
  FakeSession* fake_ = nullptr;
};

}  // namespace hapticwall::test
