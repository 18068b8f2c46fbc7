// Marks set during a recording, and their lines in the plots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/draw/figure/figure.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;

class MarksTest : public GuiTest {
 protected:
  // Number of pixels of a column of the force plot with the colour of a mark.
  [[nodiscard]] int marked_pixels(double time_s) {
    const ui::TimeView& time = state().time;
    const ItemRect area = rect("plot Force");
    const double share = (time_s - time.from_s) / (time.to_s - time.from_s);
    const float x = std::round(area.at(static_cast<float>(share), 0.0F).x);
    const ItemRect column{ImVec2(x - 2.0F, area.from.y), ImVec2(x + 3.0F, area.to.y)};
    constexpr int kTolerance = 80;
    return count_tone(screen(), draw::Tone::kWarning, column, draw::Look::kScreen, kTolerance);
  }
};

TEST_F(MarksTest, AButtonAndAKeySetThemWhileItRecords) {
  EXPECT_FALSE(sees("mark"));
  press(ImGuiKey_M);
  EXPECT_THAT(message().text, HasSubstr("start one first"));
  click("record");
  EXPECT_FALSE(sees("recording name"));
  live(300);
  press(ImGuiKey_M);
  press(ImGuiKey_Escape);
  live(200);
  click("mark");
  const auto marks = fake_->marks();
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].tick, 299U);
  EXPECT_EQ(marks[1].tick, 499U);
  EXPECT_EQ(marks[1].text, "");
  click("record");
  EXPECT_FALSE(sees("mark"));
}

TEST_F(MarksTest, TypedWordsBelongToOneMark) {
  click("record");
  live(100);
  type("mark text", "touch");
  ASSERT_EQ(fake_->marks().size(), 1U);
  EXPECT_EQ(fake_->marks()[0].text, "touch");
  // Typed, then set by the button; meanwhile M is a letter.
  click("mark text");
  press(ImGuiKey_M);
  write("me");
  EXPECT_EQ(fake_->marks().size(), 1U);
  click("mark");
  ASSERT_EQ(fake_->marks().size(), 2U);
  EXPECT_EQ(fake_->marks()[1].text, "me");
  press(ImGuiKey_Escape);
  press(ImGuiKey_M);
  ASSERT_EQ(fake_->marks().size(), 3U);
  EXPECT_EQ(fake_->marks()[2].text, "") << "each word counts once";
}

// Letters that are keys otherwise: the trigger, pause, and arming a device.
TEST_F(MarksTest, MSetsTheMarkAtOnceAndTheNextLettersNameIt) {
  click("record");
  live(300);
  ImGuiIO& io = ImGui::GetIO();
  for (const auto& [key, letter] :
       {std::pair{ImGuiKey_M, 'm'}, {ImGuiKey_T, 't'}, {ImGuiKey_A, 'a'}, {ImGuiKey_P, 'p'}}) {
    io.AddKeyEvent(key, true);
    io.AddInputCharacter(static_cast<unsigned int>(letter));
    io.AddKeyEvent(key, false);
    frames(letter == 'm' ? 4 : 0);
  }
  frames(10);
  live(200);
  ASSERT_EQ(fake_->marks().size(), 1U);
  press(ImGuiKey_Enter);
  ASSERT_EQ(fake_->marks().size(), 1U);
  EXPECT_EQ(fake_->marks()[0].tick, 299U) << "the moment of the key";
  EXPECT_EQ(fake_->marks()[0].text, "tap");
  EXPECT_TRUE(fake_->arm_requests.empty());
  EXPECT_FALSE(fake_->is_paused);
  EXPECT_EQ(state().plots.persisted.trigger.mode, draw::TriggerMode::kOff);
  press(ImGuiKey_M);
  press(ImGuiKey_Escape);
  type("mark text", "next");
  ASSERT_EQ(fake_->marks().size(), 3U);
  EXPECT_EQ(fake_->marks()[1].text, "");
  EXPECT_EQ(fake_->marks()[2].text, "next");
}

// A fast hand: all events within one frame, before the field has the keyboard.
TEST_F(MarksTest, LettersRightAfterMAreNeverKeys) {
  click("record");
  live(100);
  ImGuiIO& io = ImGui::GetIO();
  for (const ImGuiKey key : {ImGuiKey_M, ImGuiKey_A, ImGuiKey_P, ImGuiKey_T, ImGuiKey_R}) {
    io.AddKeyEvent(key, true);
    io.AddKeyEvent(key, false);
  }
  frames(12);
  EXPECT_TRUE(fake_->arm_requests.empty());
  EXPECT_FALSE(fake_->is_paused);
  EXPECT_EQ(fake_->resets, 0);
  EXPECT_EQ(state().plots.persisted.trigger.mode, draw::TriggerMode::kOff);
}

TEST_F(MarksTest, ThePlotsShowThem) {
  click("record");
  live(3000);
  press(ImGuiKey_M);
  live(4000);
  move_away();
  const double time_s = static_cast<double>(fake_->marks()[0].tick) / 1000.0;
  const ItemRect area = rect("plot Force");
  const int height = static_cast<int>(area.to.y - area.from.y);
  EXPECT_GT(marked_pixels(time_s), height / 2);
  EXPECT_LT(marked_pixels(time_s + 1.0), height / 4);
}

TEST(MarksOfAFigure, AreDrawn) {
  const Scene scene = file::load_scene("press")->scene;
  draw::SampleHistory history(10);
  constexpr std::array kForceOnly{draw::PlotId::kForce};
  draw::FigureView view;
  view.window = {0.0, 1.0};
  view.plots = kForceOnly;
  const auto drawn = [&] {
    const auto figure = draw::draw_figure(scene, history, view);
    EXPECT_TRUE(figure.ok());
    return *figure;
  };
  const file::Picture without = drawn();
  const std::array marks{file::Mark{500, "half"}};
  view.marks = {marks, 1000.0};
  const file::Picture with = drawn();
  int rows = 0;  // rows of pixels that the mark changes
  for (int y = 0; y < with.height; ++y) {
    const auto row = [&](const file::Picture& picture) {
      return picture.rgba.begin() + static_cast<std::ptrdiff_t>(4) * y * picture.width;
    };
    if (!std::equal(row(with), row(with) + static_cast<std::ptrdiff_t>(4) * with.width,
                    row(without)))
      ++rows;
  }
  EXPECT_GT(rows, 2 * with.height / 5) << "a line from the top of the plot to its bottom";
}

}  // namespace
}  // namespace hapticwall::test
