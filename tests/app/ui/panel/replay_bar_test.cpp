// A recording in the window: opening, playing, and the way back.
#include "app/ui/panel/replay_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "app/file/recording/recording_writer.h"
#include "tests/app/ui/replay_support.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;

class ReplayBarTest : public ReplayGuiTest {
 protected:
  void SetUp() override {
    ReplayGuiTest::SetUp();
    record("trial.csv", 900, {"first touch", ""});
  }
  [[nodiscard]] std::uint64_t tick() { return replay().snapshot().newest.x().tick; }
  [[nodiscard]] const std::vector<std::string>& recent() const { return state().scene.recent; }
  // Clicks at a share of the track, from 0 to 1.
  void click_slider(double share) {
    const ItemRect rect = this->rect("time slider");
    const float inset = 0.55F * ImGui::GetStyle().FontSizeBase;
    const float width = rect.to.x - rect.from.x - 2.0F * inset;
    click_at(ImVec2(rect.from.x + inset + static_cast<float>(share) * width, rect.centre().y));
  }
  // The controls are in the row, or in the popup at its end.
  void expect_controls() {
    if (sees("more of replay")) click("more of replay");
    for (const char* name : {"pause", "step", "reset", "speed", "speeds", "repeat",
                             "back to the scene", "time slider"})
      EXPECT_TRUE(sees(name)) << name;
    press(ImGuiKey_Escape);
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

TEST(ReplaySpeeds, StepThroughTheUsualSpeeds) {
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
  expect_controls();
  EXPECT_TRUE(sees("trial.csv"));
  for (const char* item : {"record", "recording name", "mark"}) EXPECT_FALSE(sees(item)) << item;
  EXPECT_EQ(application_->history().size(), 1U) << "nothing of the session before";
}

TEST_F(ReplayBarTest, TheListOpensItAgain) {
  drop("trial.csv");
  click("back to the scene");
  ASSERT_FALSE(replaying());
  click("scene");
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
  click("step");
  EXPECT_EQ(tick(), 302U);
  press(ImGuiKey_LeftArrow);
  EXPECT_EQ(tick(), 301U);
  expect_whole_history();
  press(ImGuiKey_R);
  EXPECT_EQ(tick(), 0U);
  click("pause");
  pass_ms(2000);
  EXPECT_EQ(tick(), 899U) << "the end";
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
  EXPECT_FALSE(state().time.follow);
  click_slider(0.2);
  EXPECT_TRUE(state().time.follow);
}

TEST_F(ReplayBarTest, ASpeedIsInForceOrRefused) {
  drop("trial.csv");
  type("speed", "2");
  const std::uint64_t before = tick();
  pass_ms(100);
  EXPECT_EQ(tick(), before + 200);
  type("speed", "500");
  EXPECT_EQ(replay().speed(), 2.0);
  const std::string why = "500 is out of range; it takes 0.01 to 100";
  const ItemRect line = rect(why);
  EXPECT_GE(line.from.y, rect("speed").to.y) << "below its field";
  EXPECT_EQ(line.from.x, rect("speed").from.x);
  EXPECT_EQ(message().kind, ui::MessageKind::kNone);
  type("speed", "fast");
  EXPECT_THAT(refusal()->why, HasSubstr("fast"));
  type("speed", "3");
  EXPECT_FALSE(refusal());
  EXPECT_EQ(replay().speed(), 3.0);
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
  EXPECT_TRUE(sees("device.mass_kg")) << "it can be looked at";
  type("device.mass_kg", "3");
  EXPECT_EQ(replay().scene().x().walls[0].stiffness_n_per_m, before.x().walls[0].stiffness_n_per_m);
  EXPECT_EQ(replay().scene().x().device.mass_kg, before.x().device.mass_kg);
  EXPECT_EQ(message().kind, ui::MessageKind::kNone) << message().text;
  EXPECT_EQ(replay().overlay(), nullptr);
  EXPECT_TRUE(replaying());
}

TEST_F(ReplayBarTest, TheWayBackLeadsToTheSceneWithItsChangedValues) {
  type("stiffness", "12345");
  ASSERT_TRUE(sees("reset to scene"));
  drop("trial.csv");
  EXPECT_FALSE(sees("reset to scene"));
  drop("trial.csv");  // a second recording keeps the scene to go back to
  click("back to the scene");
  ASSERT_FALSE(replaying());
  EXPECT_EQ(sessions, 2);
  EXPECT_EQ(scene().name, "press");
  EXPECT_EQ(wall().stiffness_n_per_m, 12345.0);
  EXPECT_TRUE(sees("reset to scene"));
  EXPECT_TRUE(sees("record"));
  EXPECT_TRUE(application_->history().empty());
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_NE(wall().stiffness_n_per_m, 12345.0) << "the undo list has survived";
  EXPECT_EQ(sessions, 2);
}

TEST_F(ReplayBarTest, AnotherSceneIsStartedFromAReplay) {
  drop("trial.csv");
  click_figure("Figure 4");
  EXPECT_FALSE(replaying());
  EXPECT_EQ(scene().name, "press");
  EXPECT_EQ(sessions, 2);
}

TEST_F(ReplayBarTest, ABrokenRecordingIsReportedAndTheSessionContinues) {
  live(300);
  const FakeSession* session = fake_;
  put("broken.csv", "tick,time_s\n1,2\n");
  drop("broken.csv");
  EXPECT_FALSE(replaying());
  EXPECT_EQ(&application_->session(), session);
  EXPECT_EQ(newest().tick, 299U);
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
  EXPECT_TRUE(sees("arm"));
  drop("trial.csv");
  ASSERT_TRUE(replaying());
  EXPECT_EQ(devices_open, 0);
  EXPECT_FALSE(sees("arm"));
  refuse_device = "unplugged";
  click("back to the scene");
  EXPECT_TRUE(replaying()) << "the replay continues, because the device failed";
  EXPECT_THAT(message().text, HasSubstr("unplugged"));
  refuse_device.clear();
  click("back to the scene");
  EXPECT_FALSE(replaying());
  EXPECT_EQ(devices_open, 1);
  EXPECT_TRUE(sees("arm"));
}

TEST_F(ReplayBarTest, ARunningRecordingIsFinishedFirst) {
  click("record");
  live(100);
  drop("trial.csv");
  EXPECT_TRUE(replaying());
  EXPECT_THAT(message().text, HasSubstr("recording finished: "));
}

TEST_F(ReplayBarTest, ARecordingOfADeviceShowsTheMeasuredPosition) {
  auto writer = file::RecordingWriter::create(path("d.csv"), file::csv_columns(false));
  ASSERT_TRUE(writer);
  FakeSession session(session::test::contact_scene());
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

TEST_F(ReplayBarTest, AnUnfinishedRecordingIsShownUpToItsLastRow) {
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
    state().appearance.forced_scale = scale;
    frames(3);
    expect_within(kScreenWidth);
    expect_controls();
  }
}

}  // namespace
}  // namespace hapticwall::test
