#include <gtest/gtest.h>

#include "app/ui/state/messages.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ui::MessageKind;
using ui::Toasts;

TEST(Toasts, NotesFadeAndProblemsStay) {
  Toasts toasts;
  toasts.tell(MessageKind::kNote, "done");
  toasts.tell(MessageKind::kProblem, "wrong");
  EXPECT_FALSE(toasts.moving());
  toasts.pass(ui::kNoteLifeS - 0.5 * ui::kFadeS, 0);
  EXPECT_TRUE(toasts.moving());
  EXPECT_NEAR(ui::opacity(toasts.list()[0]), 0.5, 1e-6);
  EXPECT_EQ(ui::opacity(toasts.list()[1]), 1.0F);
  toasts.pass(ui::kFadeS, 0);
  ASSERT_EQ(toasts.list().size(), 1U);
  EXPECT_EQ(toasts.newest().text, "wrong");
  toasts.pass(1e6, 0);
  EXPECT_EQ(toasts.list().size(), 1U);
  EXPECT_FALSE(toasts.moving());
}

TEST(Toasts, AToastUnderThePointerDoesNotAge) {
  Toasts toasts;
  toasts.tell(MessageKind::kNote, "done");
  const std::uint64_t id = toasts.list()[0].id;
  for (int i = 0; i < 10; ++i) toasts.pass(ui::kNoteLifeS, id);
  EXPECT_EQ(toasts.list().size(), 1U);
}

TEST(Toasts, ARepeatedMessageIsCountedAndBecomesTheNewest) {
  Toasts toasts;
  toasts.tell(MessageKind::kProblem, "a");
  toasts.tell(MessageKind::kProblem, "b");
  toasts.tell(MessageKind::kProblem, "a");
  ASSERT_EQ(toasts.list().size(), 2U);
  EXPECT_EQ(toasts.list()[1].message.text, "a");
  EXPECT_EQ(toasts.list()[1].times, 2);
  toasts.tell(MessageKind::kNote, "a");
  EXPECT_EQ(toasts.list().size(), 3U) << "a note and a problem are different messages";
}

TEST(Toasts, TheNumberOfToastsIsLimited) {
  Toasts toasts;
  for (std::size_t i = 0; i < 10 * ui::kMaxToasts; ++i)
    toasts.tell(MessageKind::kProblem, std::to_string(i));
  EXPECT_EQ(toasts.list().size(), ui::kMaxToasts);
}

class ToastsTest : public GuiTest {
 protected:
  void tell(MessageKind kind, const std::string& text) {
    state().toasts.tell(kind, text);
    frames(3);
  }
  [[nodiscard]] std::size_t count() const { return state().toasts.list().size(); }
};

TEST_F(ToastsTest, AFrameThatTookLongDoesNotTakeANoteAway) {
  tell(MessageKind::kNote, "exported the figure");
  const float usual = ImGui::GetIO().DeltaTime;
  ImGui::GetIO().DeltaTime = 10.0F * static_cast<float>(ui::kNoteLifeS);
  frames(1);
  ImGui::GetIO().DeltaTime = usual;
  frames(1);
  EXPECT_EQ(count(), 1U);
}

TEST_F(ToastsTest, TheStackIsWithinTheWindowAndNoneCoversAnother) {
  for (int i = 0; i < 12; ++i) tell(MessageKind::kProblem, "problem " + std::to_string(i));
  float below = static_cast<float>(kScreenHeight);
  std::size_t shown = 0;
  const auto& toasts = state().toasts.list();
  for (auto toast = toasts.rbegin(); toast != toasts.rend(); ++toast) {
    const auto place = find("toast " + std::to_string(toast->id));
    if (!place) continue;
    ++shown;
    EXPECT_LE(place->to.y, below);
    EXPECT_GE(place->from.x, 0.0F);
    EXPECT_LE(place->to.x, static_cast<float>(kScreenWidth));
    below = place->from.y;
  }
  EXPECT_EQ(shown, 5U);
}

TEST_F(ToastsTest, AClickOnAMessageDoesNotReachWhatIsUnderIt) {
  tell(MessageKind::kProblem, "wrong");
  const double before_s = state().time.from_s;
  drag_by("message", ImVec2(-200.0F, 0.0F));
  EXPECT_EQ(state().time.from_s, before_s);
  EXPECT_TRUE(state().time.follow);
}

}  // namespace
}  // namespace hapticwall::test
