#include <gtest/gtest.h>

#include "app/ui/window/window.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

TEST(Idleness, RestsAWhileAfterTheLastThingThatHappened) {
  ui::Idleness idleness;
  EXPECT_FALSE(idleness.idle(0.0));
  EXPECT_EQ(idleness.frame_s(0.0), ui::kFrameS);
  EXPECT_TRUE(idleness.idle(ui::kAwakeS));
  EXPECT_EQ(idleness.frame_s(10.0), ui::kIdleFrameS);
  idleness.wake(10.0);
  EXPECT_FALSE(idleness.idle(10.0 + 0.9 * ui::kAwakeS));
  EXPECT_TRUE(idleness.idle(10.0 + ui::kAwakeS));
}

class IdlenessTest : public GuiTest {
 protected:
  // Waits until the picture of the wall is refined.
  void settle() { frames(kSettlingFrames); }

  static constexpr int kSettlingFrames = 20;
};

TEST_F(IdlenessTest, TheWindowMovesWhileSamplesCome) {
  settle();
  EXPECT_FALSE(application_->moving());
  fake_->advance(1);
  frames(1);
  EXPECT_TRUE(application_->moving());
  settle();
  EXPECT_FALSE(application_->moving());
}

TEST_F(IdlenessTest, TheWindowMovesWhileAMessageFades) {
  settle();
  state().toasts.tell(ui::MessageKind::kNote, "done");
  int moving = 0;
  for (int frame = 0; frame < 60 * 8; ++frame) {
    frames(1);
    moving += application_->moving() ? 1 : 0;
  }
  constexpr int kFadingFrames = static_cast<int>(60 * ui::kFadeS);
  EXPECT_NEAR(moving, kFadingFrames, 3);
  EXPECT_EQ(message().kind, ui::MessageKind::kNone);
}

TEST_F(IdlenessTest, SamplesAreTakenWithoutDrawing) {
  fake_->advance(5000);
  application_->take_ticks();
  EXPECT_EQ(application_->history().size(), 5000U);
}

}  // namespace
}  // namespace hapticwall::test
