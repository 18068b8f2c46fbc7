#include "app/ui/window/paint_gate.h"

#include <gtest/gtest.h>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

class PaintGateTest : public GuiTest {
 protected:
  bool paints() {
    return gate_.needs_painting(*ImGui::GetDrawData(), application_->renderer().times_drawn());
  }
  // Draws until nothing moves any more; the textures have been uploaded.
  void rest() {
    fake_->is_paused = true;
    frames(30);
    static_cast<void>(screen());
    frames(120);
    static_cast<void>(paints());
  }
  ui::PaintGate gate_;
};

TEST_F(PaintGateTest, AtRestNothingIsPaintedAgain) {
  rest();
  for (int i = 0; i < 30; ++i) {
    frames(1);
    EXPECT_FALSE(paints()) << i;
  }
}

TEST_F(PaintGateTest, EveryChangeIsPaintedOnce) {
  rest();
  const auto settle = [this] {
    frames(60);
    static_cast<void>(screen());  // uploads new glyphs
    static_cast<void>(paints());
    frames(1);
    EXPECT_FALSE(paints());
  };
  move_to(rect("reset").centre());
  EXPECT_TRUE(paints()) << "the button is lit";
  settle();
  fake_->advance(1);
  frames(1);
  EXPECT_TRUE(paints()) << "the time has a new digit";
  settle();
  gate_.forget();
  EXPECT_TRUE(paints()) << "the window was covered";
  EXPECT_FALSE(paints());
  EXPECT_TRUE(gate_.needs_painting(*ImGui::GetDrawData(), 12345)) << "a texture has changed";
}

}  // namespace
}  // namespace hapticwall::test
