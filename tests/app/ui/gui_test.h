// An application on a fake session, drawn off-screen and used with pointer and keys. Time passes
// only by frames.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/draw/figure/gl_objects.h"
#include "app/file/scene/scene_file.h"
#include "app/session/experiment.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/window/application.h"
#include "tests/app/session/support.h"
#include "tests/app/sound/live/busy_card.h"
#include "tests/app/ui/fake_session.h"
#include "tests/app/ui/items.h"
#include "tests/app/ui/offscreen_gui.h"
#include "tests/app/ui/pixels.h"
#include "tests/app/ui/show_everything.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {

inline constexpr int kScreenWidth = 1280;
inline constexpr int kScreenHeight = 1250;  // the whole control panel, with a section open

class GuiTest : public FolderTest {
 protected:
  void SetUp() override {
    auto target = draw::GlTarget::create(kScreenWidth, kScreenHeight, 0);
    ASSERT_TRUE(target.ok());
    target_ = std::move(*target);
    open("press");
  }

  void TearDown() override {
    application_.reset();
    target_.reset();
  }

  void open(const std::string& scene_name) {
    const auto start =
        [this](const Scene& scene,
               BorrowedAlgorithm* borrowed) -> Result<std::unique_ptr<session::LiveSession>> {
      if (borrowed != nullptr) return start_experiment(scene, borrowed);
      if (!refuse_session.empty()) return Error{ErrorKind::kDevice, refuse_session};
      auto session = std::make_unique<FakeSession>(scene);
      fake_ = session.get();
      ++sessions;
      return std::unique_ptr<session::LiveSession>(std::move(session));
    };
    ui::Application::Sessions starters;
    starters.simulate = start;
    starters.open_recording = open_recording;
    starters.open_card = open_card;
    if (with_device) {
      starters.start_on_device = [this, start](const Scene& scene, BorrowedAlgorithm* borrowed) {
        EXPECT_EQ(devices_open, 0) << "there is one device only";
        if (!refuse_device.empty()) {
          return Result<std::unique_ptr<session::LiveSession>>(
              Error{ErrorKind::kDevice, refuse_device});
        }
        auto session = start(scene, borrowed);
        if (session && borrowed == nullptr) {
          fake_->info = {"paddle", false};
          fake_->arming.state = session::ArmingState::kOff;
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
    if (shows_everything) show_everything(state());
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

  // Draws frames until the condition holds. The generous bound only catches a broken program.
  void frames_until(const std::function<bool()>& condition) {
    EXPECT_TRUE(session::test::eventually([&] {
      frames(1);
      return condition();
    }));
  }

  // Paints only when the test needs pixels, because painting is slow without a graphics card.
  file::Picture screen() {
    frames(1);
    target_->bind();
    const ImVec4 ground = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
    glClearColor(ground.x, ground.y, ground.z, 1.0F);
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

  // Advances the session, with a frame every 100 ticks.
  void live(int ticks) {
    constexpr int kTicksPerFrame = 100;
    for (int done = 0; done < ticks; done += kTicksPerFrame) {
      fake_->advance(std::min(kTicksPerFrame, ticks - done));
      frames(1);
    }
  }

  // Drops a file of the folder, and waits until it is open.
  void drop(const std::string& name) {
    const std::array paths{path(name)};
    application_->drop(paths);
    frames_until([&] { return !state().replay.opening.running(); });
    frames(2);
  }

  void press(ImGuiKeyChord chord) {
    ImGuiIO& io = ImGui::GetIO();
    const auto hold_modifiers = [&](bool down) {
      for (const ImGuiKey modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt}) {
        if ((chord & modifier) != 0) io.AddKeyEvent(modifier, down);
      }
    };
    const auto key = static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_);
    hold_modifiers(true);
    io.AddKeyEvent(key, true);
    frames(2);
    io.AddKeyEvent(key, false);
    hold_modifiers(false);
    frames(2);
  }

  void move_to(ImVec2 place) {
    ImGui::GetIO().AddMousePosEvent(place.x, place.y);
    frames(2);
  }
  // Moves the pointer to a place where it covers nothing.
  void move_away() { move_to(ImVec2(2.0F, 2.0F)); }
  void mouse_button(bool down, ImGuiMouseButton button = ImGuiMouseButton_Left) {
    ImGui::GetIO().AddMouseButtonEvent(button, down);
    frames(2);
  }
  void click_at(ImVec2 place) {
    move_to(place);
    mouse_button(true);
    mouse_button(false);
    frames(2);
  }
  void drag(ImVec2 from, ImVec2 to, ImGuiMouseButton button = ImGuiMouseButton_Left) {
    move_to(from);
    mouse_button(true, button);
    for (const float share : {0.3F, 0.7F, 1.0F})
      move_to(ImVec2(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)));
    mouse_button(false, button);
  }
  void drag_by(const std::string& item, ImVec2 by,
               ImGuiMouseButton button = ImGuiMouseButton_Left) {
    const ImVec2 from = rect(item).centre();
    drag(from, ImVec2(from.x + by.x, from.y + by.y), button);
  }
  void wheel_at(ImVec2 place, float notches) {
    move_to(place);
    ImGui::GetIO().AddMouseWheelEvent(0.0F, notches);
    frames(5);
  }

  [[nodiscard]] static std::optional<ItemRect> find(const std::string& item) {
    return find_item(item);
  }
  [[nodiscard]] static bool sees(const std::string& item) { return find(item).has_value(); }
  [[nodiscard]] static ItemRect rect(const std::string& item) {
    const auto found = find(item);
    EXPECT_TRUE(found.has_value()) << item;
    return found.value_or(ItemRect{});
  }

  void click(const std::string& item) { click_at(rect(item).centre()); }

  // A button of the paper's figures, which stand in the layouts of these figures.
  void click_figure(const std::string& label) {
    state().plots.persisted.arrangement = ui::PlotArrangement::kFigure4;
    frames(2);
    click(label);
  }

  // Scrolls the area under an item to its end.
  void scroll_down_at(const std::string& item) { wheel_at(rect(item).centre(), -100.0F); }

  void write(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frames(3);
  }
  // Types into a field and confirms with Enter.
  void type(const std::string& item, const std::string& text) {
    click(item);
    write(text);
    press(ImGuiKey_Enter);
  }

  // Begins equal trials of two walls, each "KEY=VALUE; KEY=VALUE"; the participant decides the
  // order.
  void start_trials(int count, const std::string& a = "algorithm=none",
                    const std::string& b = "algorithm=energy-bounding",
                    const std::string& participant = "P1") {
    std::string list = "a,b\n";
    for (int i = 0; i < count; ++i) list += a + "," + b + "\n";
    put("trials.csv", list);
    const std::string answers = path(fmt::format("answers-{}.csv", ++experiments_));
    const std::string base = file::scene_to_toml(scene());
    const auto experiment = session::open_experiment(
        {path("trials.csv"), participant, "1", answers, false},
        [&](std::span<const std::string> overrides) -> Result<Scene> {
          Result<file::LoadedScene> loaded = file::parse_scene(base, "scene", overrides);
          if (!loaded) return loaded.error();
          return loaded->scene;
        });
    ASSERT_TRUE(experiment.ok()) << experiment.error().message;
    ASSERT_FALSE(
        ui::start_experiment(state().compare, state().dock, state().toasts, scene(), *experiment));
    frames(3);
    click("go on");
    ASSERT_TRUE(ui::blind_test_runs(state().compare));
  }

  // Every item lies between the left and the right edge of the window.
  static void expect_within(float width) {
    for (const auto& [name, item] : drawn_items()) {
      if (item.id == 0) continue;
      EXPECT_GE(item.from.x, 0.0F) << name;
      EXPECT_LE(item.to.x, width) << name;
    }
  }

  // Number of pixels of a tone in an item.
  static int count_tone(const file::Picture& picture, draw::Tone tone, const ItemRect& area,
                        draw::Look look = draw::Look::kScreen, int tolerance = 24) {
    const ImVec4& colour = draw::theme_colours(look)[static_cast<std::size_t>(tone)];
    return count_pixels(picture, colour_of(colour), static_cast<int>(area.from.x),
                        static_cast<int>(area.from.y), static_cast<int>(area.to.x),
                        static_cast<int>(area.to.y), tolerance);
  }

  // Number of pixels in an item that differ between two pictures.
  static int count_changed(const file::Picture& before, const file::Picture& after,
                           const ItemRect& area) {
    int count = 0;
    for (int y = static_cast<int>(area.from.y); y < static_cast<int>(area.to.y); ++y) {
      for (int x = static_cast<int>(area.from.x); x < static_cast<int>(area.to.x); ++x)
        if (difference(pixel(before, x, y), pixel(after, x, y)) > 0) ++count;
    }
    return count;
  }

  [[nodiscard]] ui::UiState& state() const { return application_->state(); }
  [[nodiscard]] const Scene& scene() const { return fake_->scene(); }
  [[nodiscard]] const WallSettings& wall() const { return scene().x().walls.front(); }
  [[nodiscard]] Sample newest() const { return fake_->snapshot().newest.x(); }

  // The newest message; kind kNone without one.
  [[nodiscard]] ui::Message message() const { return state().toasts.newest(); }

  [[nodiscard]] const std::optional<ui::Refusal>& refusal() const { return state().edit.refusal; }

  std::string refuse_session;        // the error of the next sessions
  std::string refuse_device;         // the error of the next sessions on the device
  ui::Application::Options options;  // of the next open()
  ui::Application::RecordingOpener open_recording;
  session::StartSession start_experiment;  // starts sessions under an algorithm
  int experiments_ = 0;                    // that start_trials() began
  sound::OpenCard open_card = sound::test::no_card;
  int sessions = 0;
  bool with_device = false;  // the next open() has a real device
  bool shows_everything = true;
  int devices_open = 0;
  OffscreenGui gui_{ImVec2(kScreenWidth, kScreenHeight)};
  std::optional<draw::GlTarget> target_;
  std::unique_ptr<ui::Application> application_;
  FakeSession* fake_ = nullptr;
};

}  // namespace hapticwall::test
