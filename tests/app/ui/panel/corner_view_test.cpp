// The window with a scene of two axes.
#include <gtest/gtest.h>

#include "app/ui/widget/shown_axis.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

class CornerViewTest : public GuiTest {
 protected:
  void SetUp() override {
    GuiTest::SetUp();
    open("corner");
  }
};

TEST_F(CornerViewTest, TheWallFieldsAreOfTheShownAxis) {
  live(500);
  EXPECT_FALSE(sees("wall 2")) << "one wall on either axis";
  click("wall axis y");
  EXPECT_EQ(state().selection.axis, ui::Axis::kY);
  type("stiffness", "1234");
  EXPECT_EQ(scene().axes[1].walls.front().stiffness_n_per_m, 1234.0);
  EXPECT_EQ(wall().stiffness_n_per_m, 35000.0);
  click("undo");
  EXPECT_EQ(scene().axes[1].walls.front().stiffness_n_per_m, 20000.0);
  click("wall axis x");
  type("stiffness", "4321");
  EXPECT_EQ(scene().axes[1].walls.front().stiffness_n_per_m, 20000.0);
  EXPECT_EQ(wall().stiffness_n_per_m, 4321.0);
}

TEST_F(CornerViewTest, ThePointerLeadsBothHands) {
  live(100);
  const auto hand_m = [this](std::size_t axis) {
    return fake_->snapshot().newest.axes.at(axis).truth.hand_path_m;
  };
  const double x_before_m = hand_m(0);
  const double y_before_m = hand_m(1);
  const ItemRect view = rect("wall view");
  move_to(view.centre());
  mouse_button(true);
  move_to(ImVec2(view.centre().x + 20.0F, view.centre().y - 30.0F));
  fake_->advance(500);
  EXPECT_NE(hand_m(0), x_before_m);
  EXPECT_NE(hand_m(1), y_before_m);
  mouse_button(false);
}

TEST_F(CornerViewTest, EitherAxisHasItsOwnPlots) {
  live(2000);
  const auto first = screen();
  click("plots axis y");
  move_to(ImVec2(1.0F, 1.0F));
  const auto second = screen();
  const ItemRect plot = rect("plot Position");
  EXPECT_GT(count_changed(first, second, plot), 200) << "the hand comes later on axis y";
}

TEST_F(CornerViewTest, AnotherSceneShowsItsOnlyAxis) {
  click("wall axis y");
  open("press");
  EXPECT_FALSE(sees("wall axis y"));
  type("stiffness", "777");
  EXPECT_EQ(wall().stiffness_n_per_m, 777.0);
}

}  // namespace
}  // namespace hapticwall::test
