// A change is shown as asked for until the loop has echoed it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/stabiliser/stabiliser.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class AskedForTest : public GuiTest {
 protected:
  static constexpr const char* kAskedFor = "asked for";
};

TEST_F(AskedForTest, AnAlgorithmIsInForceOnceTheLoopHasEchoedIt) {
  const std::string name(algorithms()[1].name);
  fake_->echoes = false;
  press(ImGuiKey_2);
  EXPECT_EQ(application_->session().scene().algorithm.index, 1U);
  EXPECT_THAT(text(), HasSubstr("2   " + name + "   asked for"));
  EXPECT_THAT(text(), Not(HasSubstr("in force")));
  fake_->echoes = true;
  frames(1);
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
  EXPECT_THAT(text(), HasSubstr("in force"));
}

TEST_F(AskedForTest, AWallIsInForceOnceTheLoopHasEchoedIt) {
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
  fake_->echoes = false;
  type("stiffness", "2000");
  EXPECT_EQ(application_->session().scene().x().walls.front().stiffness_n_per_m, 2000.0);
  EXPECT_THAT(text(), HasSubstr(kAskedFor));
  type("stiffness", "3000");
  EXPECT_THAT(text(), HasSubstr(kAskedFor)) << "neither of the two";
  fake_->echoes = true;
  frames(1);
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
}

TEST_F(AskedForTest, ANewSessionHasNothingThatIsOnlyAskedFor) {
  fake_->echoes = false;
  press(ImGuiKey_3);
  ASSERT_THAT(text(), HasSubstr(kAskedFor));
  type("rate", "2000");
  frames(2);
  EXPECT_EQ(sessions, 2);
  EXPECT_THAT(text(), Not(HasSubstr(kAskedFor)));
}

}  // namespace
}  // namespace hapticwall::test
