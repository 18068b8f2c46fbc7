// The wall's rows: bounds of theory beside the stiffness.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/study/stability_bounds.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class WallPanel : public GuiTest {
 protected:
  static std::string limit_text(const Scene& scene, const LoopDelay& delay) {
    return fmt::format("{:.0f} N/m",
                       *stability_bounds(scene, scene.x().walls[0], delay).stable_n_per_m);
  }
  void point_at_limit() {
    const auto row = find_item("bound, stable");
    ASSERT_TRUE(row);
    move_to(row->centre());
    frames(60);  // tooltips take their time
  }
};

TEST_F(WallPanel, ShowsTheExactLimitOfTheSimulatedLoop) {
  const Scene scene = file::load_scene("press")->scene;
  EXPECT_THAT(text(), HasSubstr(limit_text(scene, delay_of(scene))));
  EXPECT_THAT(text(), Not(HasSubstr("The rule K <")));
  point_at_limit();
  EXPECT_THAT(text(), HasSubstr("handle, hand, hold"));
  EXPECT_THAT(text(), HasSubstr("The rule K < (b + B) / (T/2 + t_d) gives 2000 N/m."));
}

TEST_F(WallPanel, OnADeviceTheLimitHasTheMeasuredDelayAndNoHand) {
  fake_->info = {"paddle", false};
  fake_->link.delay_s = 1.3e-3;  // ends within a tick
  frames(2);
  Scene scene = file::load_scene("press")->scene;
  scene.x().hand.reset();
  EXPECT_THAT(text(),
              HasSubstr(limit_text(scene, {.transport_s = 1.3e-3, .time_constant_s = 0.0})));
  point_at_limit();
  EXPECT_THAT(text(), HasSubstr("1300 µs as measured"));
  EXPECT_THAT(text(), Not(HasSubstr("handle, hand")));
}

TEST_F(WallPanel, AnUnknownDelayIsNotNone) {
  fake_->info = {"wheel", false};
  frames(2);
  Scene scene = file::load_scene("press")->scene;
  scene.x().hand.reset();
  EXPECT_THAT(text(), Not(HasSubstr(limit_text(scene, {}))));
  point_at_limit();
  EXPECT_THAT(text(), HasSubstr("unknown"));
  EXPECT_THAT(text(), HasSubstr("It depends on the delay of the device"));
}

}  // namespace
}  // namespace hapticwall::test
