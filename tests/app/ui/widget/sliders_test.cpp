#include "app/ui/widget/sliders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ui::LogRange;
using ui::slider_share;
using ui::slider_value;

TEST(Slider, EqualDistancesAreEqualFactors) {
  const LogRange range{100.0, 1e6};
  EXPECT_EQ(slider_value(0.0, range), 100.0);
  EXPECT_EQ(slider_value(0.25, range), 1000.0);
  EXPECT_EQ(slider_value(0.5, range), 10000.0);
  EXPECT_EQ(slider_value(1.0, range), 1e6);
  EXPECT_EQ(slider_value(-3.0, range), 100.0);
  EXPECT_EQ(slider_value(7.0, range), 1e6);
  EXPECT_DOUBLE_EQ(slider_share(1e4, range), 0.5);
  EXPECT_EQ(slider_share(0.0, range), 0.0);
  EXPECT_EQ(slider_share(1e9, range), 1.0);
}

TEST(Slider, ItsLeftEndMayStandForZero) {
  const LogRange range{0.01, 100.0, true};
  EXPECT_EQ(slider_value(0.0, range), 0.0);
  EXPECT_GT(slider_value(0.02, range), 0.0);
}

TEST(Slider, ItsValuesHaveThreeDigitsAndComeBack) {
  const LogRange range{1e-6, 1e-2};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double value = slider_value(place(random), range);
    EXPECT_LE(ui::slider_value(1.0, range), 1e-2);
    EXPECT_NEAR(slider_value(slider_share(value, range), range), value, 1e-12);
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    EXPECT_EQ(std::strtod(text, nullptr), value);
  }
}

TEST(Slider, TheRangeAroundAUsualValueIsOfWholeDecades) {
  const LogRange range = ui::range_around(0.05, false);
  EXPECT_NEAR(range.minimum, 1e-3, 1e-12);
  EXPECT_NEAR(range.maximum, 10.0, 1e-9);
}

class SliderTest : public GuiTest {
 protected:
  void drag_slider(const std::string& item, float from_share, float to_share) {
    const ItemRect slider = rect(item);
    drag(slider.at(from_share, 0.5F), slider.at(to_share, 0.5F));
  }
};

TEST_F(SliderTest, TheLeftEndOfTheSliderRemovesTheDamping) {
  drag_slider("damping-slider", 0.3F, 0.6F);
  const double damping = wall().damping_n_s_per_m;
  EXPECT_GT(damping, 1.0);
  EXPECT_LT(damping, 100.0);
  drag_slider("damping-slider", 0.6F, 0.0F);
  EXPECT_EQ(wall().damping_n_s_per_m, 0.0);
}

TEST_F(SliderTest, AClickOnTheGrabChangesNothing) {
  type("stiffness", "12345.678");
  const ItemRect slider = rect("stiffness-slider");
  const float share = static_cast<float>(slider_share(12345.678, {100.0, 1e6}));
  const float grab = 0.28F * ImGui::GetStyle().FontSizeBase;
  click_at(ImVec2(slider.from.x + grab + share * (slider.to.x - slider.from.x - 2.0F * grab),
                  slider.centre().y));
  EXPECT_EQ(wall().stiffness_n_per_m, 12345.678);
}

}  // namespace
}  // namespace hapticwall::test
