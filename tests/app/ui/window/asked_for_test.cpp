// A change is shown as asked for until the loop has echoed it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class AskedForTest : public GuiTest {
 protected:
  static constexpr const char* kAskedFor = "asked for";

  // The background behind an algorithm of the menu.
  [[nodiscard]] Colour background(std::size_t algorithm) {
    move_away();
    const ImVec2 place = rect(std::string(algorithms()[algorithm].name)).at(0.9F, 0.5F);
    return pixel(screen(), static_cast<int>(place.x), static_cast<int>(place.y));
  }
};

TEST_F(AskedForTest, AnAlgorithmIsInForceOnceTheLoopHasEchoedIt) {
  const std::size_t before = scene().algorithm.index;
  ASSERT_NE(before, 1U);
  const Colour chosen = background(before);
  ASSERT_GT(difference(chosen, background(1)), 10);
  fake_->echoes = false;
  press(ImGuiKey_2);
  EXPECT_EQ(scene().algorithm.index, 1U);
  EXPECT_THAT(text(), HasSubstr("2   " + std::string(algorithms()[1].name) + "   asked for"));
  EXPECT_THAT(text(), Not(HasSubstr("in force")));
  EXPECT_EQ(difference(chosen, background(before)), 0) << "the menu shows the one in force";
  EXPECT_GT(difference(chosen, background(1)), 10);
  fake_->echoes = true;
  frames(1);
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
  EXPECT_THAT(text(), HasSubstr("in force"));
  EXPECT_EQ(difference(chosen, background(1)), 0);
  EXPECT_GT(difference(chosen, background(before)), 10);
}

TEST_F(AskedForTest, AWallIsInForceOnceTheLoopHasEchoedIt) {
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
  fake_->echoes = false;
  type("stiffness", "2000");
  EXPECT_EQ(wall().stiffness_n_per_m, 2000.0);
  EXPECT_THAT(text(), HasSubstr(kAskedFor));
  type("stiffness", "3000");
  EXPECT_THAT(text(), HasSubstr(kAskedFor)) << "neither value is in force";
  fake_->echoes = true;
  frames(1);
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
}

TEST_F(AskedForTest, ANewSessionHasNothingThatIsOnlyAskedFor) {
  fake_->echoes = false;
  press(ImGuiKey_3);
  ASSERT_THAT(text(), HasSubstr(kAskedFor));
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
}

}  // namespace
}  // namespace hapticwall::test
