#include "app/ui/panel/wall_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

class WallViewTest : public GuiTest {
 protected:
  [[nodiscard]] ui::WallOrbit& orbit() { return state().wall.persisted.orbit; }
  [[nodiscard]] double hand_m() const { return newest().truth.hand_path_m; }
  [[nodiscard]] ui::WallCamera camera() {
    const ItemRect view = rect("wall view");
    return {ui::wall_space(scene()), orbit(), view.to.x - view.from.x, view.to.y - view.from.y};
  }
  // The place of a position on the axis, in the window.
  [[nodiscard]] ImVec2 place(double position_m) {
    const ItemRect view = rect("wall view");
    const ui::WallCamera now = camera();
    const glm::vec2 pixel = now.pixel_of(now.point_of({position_m, 0.0}));
    return {view.from.x + pixel.x, view.from.y + pixel.y};
  }
};

TEST_F(WallViewTest, TheRightButtonTurnsAndNeverLeadsTheHand) {
  drag_by("wall view", ImVec2(-80.0F, 40.0F), ImGuiMouseButton_Right);
  EXPECT_GT(orbit().yaw_rad, 0.1);
  EXPECT_GT(orbit().pitch_rad, 0.05);
  EXPECT_TRUE(fake_->moves.empty());
  const ui::WallOrbit turned = orbit();
  move_to(ImVec2(rect("wall view").centre().x + 50.0F, rect("wall view").centre().y));
  EXPECT_EQ(orbit(), turned) << "only while the button is down";
}

// The first two texts within the area that meet; empty: none.
std::string meeting_texts(const ItemRect& area) {
  Items texts = drawn_items();
  std::erase_if(texts, [&](const auto& each) {
    const ItemRect& place = each.second;
    const bool line = place.to.y - place.from.y < 2.0F * ImGui::GetFontSize();  // no window
    return place.id != 0 || !line || !area.holds(place.centre());
  });
  for (auto a = texts.begin(); a != texts.end(); ++a) {
    for (auto b = std::next(a); b != texts.end(); ++b)
      if (a->second.meets(b->second)) return a->first + " and " + b->first;
  }
  return {};
}

TEST_F(WallViewTest, NoLabelLiesOnAnother) {
  open("tap");
  for (const ImVec2 size : {ImVec2(1280.0F, 800.0F), ImVec2(1024.0F, 680.0F),
                            ImVec2(1000.0F, 640.0F), ImVec2(700.0F, 500.0F)}) {
    ImGui::GetIO().DisplaySize = size;
    for (int i = 0; i < 20; ++i) {
      live(100);
      EXPECT_EQ(meeting_texts(rect("wall view")), "") << size.x << " wide, frame " << i;
      EXPECT_EQ(meeting_texts(rect("magnifier")), "") << size.x << " wide, frame " << i;
    }
    EXPECT_TRUE(sees("position   ")) << "the readout is never left out";
  }
}

TEST_F(WallViewTest, TheMiddleButtonMovesWhatIsSeenWithThePointer) {
  const ImVec2 before = place(0.05);
  drag_by("wall view", ImVec2(30.0F, -20.0F), ImGuiMouseButton_Middle);
  EXPECT_NEAR(place(0.05).x, before.x + 30.0F, 0.1F);
  EXPECT_NEAR(place(0.05).y, before.y - 20.0F, 0.1F);
  EXPECT_TRUE(fake_->moves.empty());
}

TEST_F(WallViewTest, TheWheelZoomsAtThePointer) {
  const ImVec2 before = place(0.05);
  wheel_at(before, 3.0F);
  EXPECT_GT(orbit().zoom, 1.3);
  EXPECT_NEAR(place(0.05).x, before.x, 1.0F);
  EXPECT_NEAR(place(0.05).y, before.y, 1.0F);
}

TEST_F(WallViewTest, TheMouseKeepsTheCameraWithinItsLimits) {
  for (int i = 0; i < 12; ++i) {
    drag_by("wall view", ImVec2(300.0F, i % 2 == 0 ? 150.0F : -150.0F), ImGuiMouseButton_Right);
    drag_by("wall view", ImVec2(250.0F, 100.0F), ImGuiMouseButton_Middle);
    ImGui::GetIO().AddMouseWheelEvent(0.0F, i < 6 ? -5.0F : 9.0F);
    frames(3);
    EXPECT_EQ(ui::limited(orbit(), false), orbit());
  }
}

TEST_F(WallViewTest, TheHandIsLedRightlyFromEveryView) {
  constexpr double kPixels = 1.5;  // the pointer has whole pixels
  for (const ui::WallOrbit& view :
       {ui::WallOrbit{}, ui::WallOrbit{0.9, 0.3, 1.0, {}},
        ui::WallOrbit{-0.6, 0.9, 1.3, {0.2, 0.1}}, ui::WallOrbit{1.6, -0.2, 0.9, {}}}) {
    orbit() = view;
    frames(2);
    fake_->advance(10);
    const double before_m = hand_m();
    move_to(place(before_m));
    mouse_button(true);
    for (const double position_m : {0.045, 0.052}) {
      move_to(place(position_m));
      fake_->advance(500);
      const double pixels_per_m =
          1e3 * static_cast<double>(std::hypot(place(position_m + 1e-3).x - place(position_m).x,
                                               place(position_m + 1e-3).y - place(position_m).y));
      EXPECT_NEAR(hand_m(), position_m, kPixels / pixels_per_m);
    }
    mouse_button(false);
    press(ImGuiKey_R);
  }
}

TEST_F(WallViewTest, TheHandIsGrabbedWhereverThePointerIsAndStaysWhereItIsLeft) {
  live(500);
  const double before_m = hand_m();
  ASSERT_FALSE(state().hand.led);
  const ImVec2 anywhere = rect("wall view").at(0.7F, 0.2F);
  move_to(anywhere);
  mouse_button(true);
  fake_->advance(200);
  EXPECT_EQ(hand_m(), before_m) << "the script is suspended, and nothing jumps";
  const ImVec2 from = place(before_m);
  const ImVec2 to = place(before_m + 0.01);
  move_to(ImVec2(anywhere.x + to.x - from.x, anywhere.y + to.y - from.y));
  mouse_button(false);
  fake_->advance(500);
  EXPECT_NEAR(hand_m(), before_m + 0.01, 3e-4) << "its picture moves as the pointer does";
  const double left_m = hand_m();
  live(3000);
  EXPECT_EQ(hand_m(), left_m);
  press(ImGuiKey_R);
  EXPECT_FALSE(state().hand.led);
  live(500);
  EXPECT_EQ(hand_m(), before_m) << "reset takes up the script";
}

TEST_F(WallViewTest, AKeyWithdrawsTheHandAtTheChosenSpeed) {
  live(1000);
  const double before_m = hand_m();
  const double start_m = scene().x().device.start_m;
  state().hand.withdraw_mm_per_s = 50.0;
  press(ImGuiKey_H);
  fake_->advance(100);
  EXPECT_NEAR(hand_m(), before_m - 0.05 * 0.1, 1e-9);
  fake_->advance(2000);
  EXPECT_EQ(hand_m(), start_m);
}

TEST_F(WallViewTest, APausedHandIsNotGrabbedAndTheReasonIsGiven) {
  fake_->is_paused = true;
  drag_by("wall view", ImVec2(80.0F, 0.0F));
  press(ImGuiKey_H);
  EXPECT_TRUE(fake_->moves.empty());
  EXPECT_THAT(message().text, ::testing::HasSubstr("paused"));
}

// The hand ignores the pointer after the release, also if one frame sees both.
TEST_F(WallViewTest, TheHandDoesNotFollowThePointerBeyondTheRelease) {
  fake_->advance(10);
  const double before_m = hand_m();
  move_to(place(0.04));
  mouse_button(true);
  ImGui::GetIO().AddMouseButtonEvent(ImGuiMouseButton_Left, false);
  ImGui::GetIO().AddMousePosEvent(place(0.08).x, place(0.08).y);
  application_->point({ImGui::GetTime(), place(0.08)});
  frames(5);
  fake_->advance(2000);
  EXPECT_EQ(hand_m(), before_m);
}

TEST_F(WallViewTest, PointerEventsKeepTheirTimes) {
  fake_->advance(10);
  move_to(place(0.04));
  mouse_button(true);
  fake_->moves.clear();
  const double now_s = state().input.now_s;
  application_->point({now_s + 0.02, place(0.042)});
  application_->point({now_s + 0.05, place(0.048)});
  frames(1);
  std::vector<double> durations_s;
  for (const session::HandMove& move : fake_->moves)
    if (move.m[0] != 0.0) durations_s.push_back(move.duration_s);
  ASSERT_EQ(durations_s.size(), 2U);
  EXPECT_NEAR(durations_s.back(), 0.03, 1e-9);
}

TEST_F(WallViewTest, ShowsForceHandAndProxy) {
  live(4000);
  move_away();
  const file::Picture picture = screen();
  const auto count = [&](draw::Tone tone) {
    return count_tone(picture, tone, rect("wall view"), draw::Look::kScreen, 30);
  };
  EXPECT_GT(count(draw::Tone::kForce), 100) << "the arrow and its figure";
  EXPECT_GT(count(draw::Tone::kHand), 10) << "the hand's name";
  EXPECT_GT(count(draw::Tone::kAccent), 10) << "the true place's name";
}

TEST_F(WallViewTest, ShowsTheIntervalAndTheLampWhetherTheWallShakesOrNot) {
  const auto picture_of = [&](ImGuiKey algorithm) {
    open("press");
    press(algorithm);
    live(3000);
    const session::Snapshot snapshot = fake_->snapshot();
    const draw::Theme theme;
    return ui::shown_picture(ui::context_of(state(), *fake_, snapshot, theme, {.live = fake_}));
  };
  const ui::WallPicture shakes = picture_of(ImGuiKey_1);
  EXPECT_GT(shakes.handle_reach_m.below.x + shakes.handle_reach_m.above.x, 2e-3);
  EXPECT_GT(shakes.force_reach_n.below.x + shakes.force_reach_n.above.x, 8.0);
  EXPECT_TRUE(shakes.saturated) << "within the interval";
  EXPECT_EQ(shakes.verdict, draw::Tone::kBad);
  const ui::WallPicture quiet = picture_of(ImGuiKey_4);
  EXPECT_LT(quiet.handle_reach_m.below.x + quiet.handle_reach_m.above.x, 1e-4);
  EXPECT_FALSE(quiet.saturated);
  EXPECT_NE(quiet.verdict, draw::Tone::kBad);
}

TEST_F(WallViewTest, NothingIsDrawnAgainWhileNothingChanges) {
  live(2000);
  frames(120);  // the tint has settled, the picture is refined
  EXPECT_TRUE(state().wall.transient.view_refined);
  const std::uint64_t drawn = application_->renderer().times_drawn();
  frames(30);
  EXPECT_EQ(application_->renderer().times_drawn(), drawn);
  fake_->advance(1);
  live(200);
  EXPECT_GT(application_->renderer().times_drawn(), drawn);
}

TEST_F(WallViewTest, SlowFramesLowerTheResolutionOfAMovingPictureOnly) {
  const auto pixels = [this] {
    glBindFramebuffer(GL_FRAMEBUFFER, application_->renderer().framebuffer());
    GLint name = 0;
    glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                          GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    GLint width = 0;
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(name));
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    return width;
  };
  live(500);
  const GLint whole = pixels();
  application_->note_frame(0.05, 1.0);
  live(500);
  EXPECT_EQ(pixels(), whole / 2);
  frames(60);
  EXPECT_EQ(pixels(), whole) << "a still picture is refined";
  EXPECT_TRUE(state().wall.transient.view_refined);
}

TEST_F(WallViewTest, TheTintComesAndGoesWithTheContact) {
  const auto strength = [this] { return state().wall.transient.shown[0].strength; };
  live(100);
  EXPECT_EQ(strength(), 0.0);
  live(3000);
  frames(60);
  EXPECT_EQ(strength(), 1.0);
}

}  // namespace
}  // namespace hapticwall::test
