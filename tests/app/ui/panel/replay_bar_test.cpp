// A recording in the window: opening, playing, and the way back.
#include "app/ui/panel/replay_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/file/recording/recording_writer.h"
#include "tests/app/ui/replay_support.h"

namespace hapticwall::test {
namespace {

using draw::Quantity;
using ::testing::HasSubstr;

class ReplayBarTest : public ReplayGuiTest {
 protected:
  void SetUp() override {
    ReplayGuiTest::SetUp();
    record("trial.csv", 900, {"first touch", ""});
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  [[nodiscard]] std::uint64_t tick() { return replay().snapshot().newest.x().tick; }
  [[nodiscard]] const std::vector<std::string>& recent() const {
    return application_->state().persisted.recent;
  }
  // Of the slider's track, from 0 to 1.
  void click_slider(double share) {
    const ItemRect rect = this->rect("time slider");
    const float inset = 0.55F * ImGui::GetStyle().FontSizeBase;
    const float width = rect.to.x - rect.from.x - 2.0F * inset;
    move_to(ImVec2(rect.from.x + inset + static_cast<float>(share) * width, rect.centre().y));
    mouse_button(true);
    mouse_button(false);
  }
  void expect_whole_history() {
    const draw::SampleHistory& history = application_->history();
    for (std::size_t i = 1; i < history.size(); ++i) {
      ASSERT_EQ(history.value(&Sample::tick, i), history.value(&Sample::tick, i - 1) + 1.0);
    }
    ASSERT_FALSE(history.empty());
    EXPECT_EQ(history.value(&Sample::tick, history.size() - 1), static_cast<double>(tick()));
  }
};

TEST(ReplaySpeeds, GoUpAndDownTheUsualOnes) {
  EXPECT_EQ(ui::faster_than(1.0), 2.0);
  EXPECT_EQ(ui::slower_than(1.0), 0.5);
  EXPECT_EQ(ui::faster_than(3.3), 5.0);
  EXPECT_EQ(ui::slower_than(3.3), 2.0);
  EXPECT_EQ(ui::faster_than(100.0), 100.0);
  EXPECT_EQ(ui::slower_than(0.01), 0.01);
}

TEST_F(ReplayBarTest, ADroppedRecordingTakesThePlaceOfTheSession) {
  int open = 1;
  fake_->open_count = &open;
  live(500);
  drop("trial.csv");
  ASSERT_TRUE(replaying());
  EXPECT_EQ(open, 0) << "the session before has ended";
  EXPECT_EQ(recent(), std::vector<std::string>{path("trial.csv")});
  EXPECT_EQ(application_->session().scene().name, "contact");
  for (const char* item : {"pause", "step", "reset", "time slider", "speed", "repeat",
                           "back to the scene", "trial.csv"})
    EXPECT_TRUE(find(item).has_value()) << item;
  for (const char* item : {"record", "recording name", "mark"})
    EXPECT_FALSE(find(item).has_value()) << item;
  EXPECT_EQ(application_->history().size(), 1U) << "nothing of the session before";
}

TEST_F(ReplayBarTest, OneIsOpenedOnceMoreFromTheList) {
  drop("trial.csv");
  click("back to the scene");
  frames(2);
  ASSERT_FALSE(replaying());
  click("scene");
  frames(2);
  click("recent 1");
  frames_until([&] { return replaying(); });
  EXPECT_EQ(replay().recording().csv_path, path("trial.csv"));
}

TEST_F(ReplayBarTest, PlaysPausesStepsAndGoesToTheBeginning) {
  drop("trial.csv");
  pass_ms(300);
  EXPECT_EQ(tick(), 300U);
  expect_whole_history();
  press(ImGuiKey_P);
  pass_ms(100);
  EXPECT_EQ(tick(), 300U);
  press(ImGuiKey_S);
  press(ImGuiKey_RightArrow);
  EXPECT_EQ(tick(), 302U);
  press(ImGuiKey_LeftArrow);
  EXPECT_EQ(tick(), 301U);
  expect_whole_history();
  click("step");
  EXPECT_EQ(tick(), 302U);
  press(ImGuiKey_R);
  EXPECT_EQ(tick(), 0U);
  click("pause");
  pass_ms(2000);
  EXPECT_EQ(tick(), 899U) << "the end";
  press(ImGuiKey_S);
  EXPECT_EQ(tick(), 899U);
  click("pause");
  pass_ms(10);
  EXPECT_EQ(tick(), 10U) << "plays from the beginning again";
}

TEST_F(ReplayBarTest, TheSliderGoesAnywhereAndOntoMarks) {
  drop("trial.csv");
  press(ImGuiKey_P);
  click_slider(0.5);
  EXPECT_NEAR(static_cast<double>(tick()), 450.0, 3.0);
  expect_whole_history();
  click_slider(0.9);
  EXPECT_NEAR(static_cast<double>(tick()), 809.0, 3.0);
  expect_whole_history();
  const auto marks = replay().marks();
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].text, "first touch");
  click_slider((static_cast<double>(marks[0].tick) + 2.0) / 899.0);
  EXPECT_EQ(tick(), marks[0].tick);
  press(ImGuiKey_PageDown);
  EXPECT_EQ(tick(), marks[1].tick);
  press(ImGuiKey_PageDown);
  EXPECT_EQ(tick(), marks[1].tick) << "there is no other";
  press(ImGuiKey_PageUp);
  EXPECT_EQ(tick(), marks[0].tick);
}

TEST_F(ReplayBarTest, AJumpBringsThePlotsBackToThePlace) {
  drop("trial.csv");
  pass_ms(400);
  press(ImGuiKey_F);
  EXPECT_FALSE(application_->state().transient.follow);
  click_slider(0.2);
  EXPECT_TRUE(application_->state().transient.follow);
}

TEST_F(ReplayBarTest, TheSpeedIsChosenTypedAndSteppedThrough) {
  drop("trial.csv");
  press(ImGuiKey_P);
  click("speeds");
  frames(2);
  click("speed 0.1x");
  EXPECT_EQ(replay().speed(), 0.1);
  type("speed", "3.5");
  EXPECT_EQ(replay().speed(), 3.5);
  type("speed", "500");
  EXPECT_EQ(replay().speed(), 3.5);
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("speed: from 0.01 to 100 times; 3.5 stays"));
  press(ImGuiKey_RightBracket);
  EXPECT_EQ(replay().speed(), 5.0);
  press(ImGuiKey_LeftBracket);
  EXPECT_EQ(replay().speed(), 2.0);
  ImGui::GetIO().AddInputCharacter('[');  // wherever the keyboard has it
  frames(2);
  EXPECT_EQ(replay().speed(), 1.0);
  press(ImGuiKey_RightBracket);
  press(ImGuiKey_P);
  pass_ms(100);
  EXPECT_EQ(tick(), 200U);
}

TEST_F(ReplayBarTest, ItBeginsAnewAtTheEndWhereItIsAskedTo) {
  drop("trial.csv");
  press(ImGuiKey_L);
  EXPECT_TRUE(replay().loops());
  pass_ms(5000);
  pass_ms(50);
  EXPECT_LT(tick(), 200U);
  expect_whole_history();
  click("repeat");
  EXPECT_FALSE(replay().loops());
}

TEST_F(ReplayBarTest, NothingThatWasRecordedIsChanged) {
  drop("trial.csv");
  press(ImGuiKey_P);
  const Scene before = replay().scene();
  type("stiffness", "1234");
  click("stiffness");
  click("none");
  scroll_down_at("re-run");
  click("section Device");
  frames(2);
  EXPECT_TRUE(find("device.mass_kg").has_value()) << "it can be looked at";
  type("device.mass_kg", "3");
  EXPECT_EQ(replay().scene().x().walls[0].stiffness_n_per_m, before.x().walls[0].stiffness_n_per_m);
  EXPECT_EQ(replay().scene().x().device.mass_kg, before.x().device.mass_kg);
  EXPECT_EQ(message().kind, ui::MessageKind::kNone) << message().text;
  EXPECT_EQ(replay().overlay(), nullptr);
  EXPECT_TRUE(replaying());
}

TEST_F(ReplayBarTest, TheWayBackLeadsToTheSceneWithItsChangedValues) {
  type("stiffness", "12345");
  frames(2);
  ASSERT_TRUE(find("reset to scene").has_value());
  drop("trial.csv");
  EXPECT_FALSE(find("reset to scene").has_value());
  drop("trial.csv");  // once more does not count
  click("back to the scene");
  frames(2);
  ASSERT_FALSE(replaying());
  EXPECT_EQ(sessions, 2);
  EXPECT_EQ(fake_->scene().name, "press");
  EXPECT_EQ(fake_->scene().x().walls[0].stiffness_n_per_m, 12345.0);
  EXPECT_TRUE(find("reset to scene").has_value());
  EXPECT_TRUE(find("record").has_value());
  EXPECT_TRUE(application_->history().empty());
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, true);
  press(ImGuiKey_Z);
  ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, false);
  frames(2);
  EXPECT_NE(fake_->scene().x().walls[0].stiffness_n_per_m, 12345.0) << "undo goes on where it was";
  EXPECT_EQ(sessions, 2);
}

TEST_F(ReplayBarTest, AnotherSceneIsStartedFromAReplay) {
  drop("trial.csv");
  click("Figure 4");
  frames(2);
  EXPECT_FALSE(replaying());
  EXPECT_EQ(fake_->scene().name, "press");
  EXPECT_EQ(sessions, 2);
}

TEST_F(ReplayBarTest, WhatIsNoRecordingIsToldAndTheSessionGoesOn) {
  live(300);
  const FakeSession* session = fake_;
  put("broken.csv", "tick,time_s\n1,2\n");
  drop("broken.csv");
  EXPECT_FALSE(replaying());
  EXPECT_EQ(&application_->session(), session);
  EXPECT_EQ(fake_->snapshot().newest.x().tick, 299U);
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("broken.csv:1"));
  EXPECT_TRUE(recent().empty());
  EXPECT_EQ(application_->history().size(), 300U);
  drop("trial.csv");
  pass_ms(100);
  drop("broken.csv");
  ASSERT_TRUE(replaying());
  EXPECT_EQ(tick(), 100U) << "the replay goes on";
}

TEST_F(ReplayBarTest, ADevicesSessionIsEndedAndGoneBackTo) {
  with_device = true;
  open("press");
  EXPECT_EQ(devices_open, 1);
  EXPECT_TRUE(find("arm").has_value());
  drop("trial.csv");
  ASSERT_TRUE(replaying());
  EXPECT_EQ(devices_open, 0);
  EXPECT_FALSE(find("arm").has_value());
  refuse_device = "unplugged";
  click("back to the scene");
  frames(2);
  EXPECT_TRUE(replaying()) << "what runs goes on where the device does not";
  EXPECT_THAT(message().text, HasSubstr("unplugged"));
  refuse_device.clear();
  click("back to the scene");
  frames(2);
  EXPECT_FALSE(replaying());
  EXPECT_EQ(devices_open, 1);
  EXPECT_TRUE(find("arm").has_value());
}

TEST_F(ReplayBarTest, ARunningRecordingIsFinishedFirst) {
  click("record");
  live(100);
  drop("trial.csv");
  EXPECT_TRUE(replaying());
  EXPECT_THAT(message().text, HasSubstr("recording finished: "));
}

TEST_F(ReplayBarTest, OfADeviceTheMeasuredPositionIsShown) {
  auto writer = file::RecordingWriter::create(path("d.csv"), file::csv_columns(false));
  ASSERT_TRUE(writer);
  FakeSession session(runtime::test::contact_scene());
  session.advance(200);
  std::vector<Tick> ticks(200);
  session.take_ticks(ticks);
  for (const Tick& tick : ticks) ASSERT_FALSE((*writer)->append(tick));
  file::RecordingMetadata metadata;
  metadata.device = "paddle";
  ASSERT_FALSE((*writer)->finish(session.scene(), metadata));
  drop("d.csv");
  ASSERT_TRUE(replaying());
  pass_ms(150);
  const draw::SampleHistory& history = application_->history();
  ASSERT_EQ(history.size(), 151U);
  for (std::size_t i = 0; i < history.size(); ++i) {
    EXPECT_EQ(history.value(&PlantTruth::position_m, i), ticks[i].x().position_m);
  }
  press(ImGuiKey_1);
  EXPECT_THAT(message().text, HasSubstr("a person's hand cannot be re-run"));
}

TEST_F(ReplayBarTest, OneThatWasNeverFinishedIsShownAsFarAsItGoes) {
  std::filesystem::copy_file(path("trial.csv"), path("cut.csv.partial"));
  std::filesystem::resize_file(path("cut.csv.partial"),
                               std::filesystem::file_size(path("cut.csv.partial")) - 7);
  drop("cut.csv.partial");
  ASSERT_TRUE(replaying());
  EXPECT_EQ(replay().recording().scanned.rows, 899U);
}

TEST_F(ReplayBarTest, EverythingFitsIntoTheSmallestWindow) {
  drop("trial.csv");
  pass_ms(500);
  for (const float scale : {1.0F, 2.0F}) {
    application_->state().transient.forced_scale = scale;
    frames(3);
    for (const char* name : {"pause", "step", "reset", "speed", "speeds", "repeat",
                             "back to the scene", "time slider"}) {
      const ItemRect item = rect(name);
      EXPECT_GE(item.from.x, 0.0F) << name;
      EXPECT_LE(item.to.x, static_cast<float>(kScreenWidth)) << name << " at " << scale;
    }
  }
}

}  // namespace
}  // namespace hapticwall::test
