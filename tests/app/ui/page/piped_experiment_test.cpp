// An experiment in the window whose trials come from another program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/session/experiment.h"
#include "app/ui/state/blind_test.h"
#include "tests/app/session/piped.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class PipedExperimentTest : public GuiTest {
 protected:
  void SetUp() override {
    prepare();
    GuiTest::SetUp();
  }
  void prepare() {
    options.experiment.reset();
    peer_ = std::make_unique<session::test::Peer>();
    const auto experiment = session::open_experiment(
        {session::kPiped, "P1", "1", path("P1.csv"), false},
        [](std::span<const std::string> overrides) -> Result<Scene> {
          Result<file::LoadedScene> loaded = file::load_scene("press", overrides);
          if (!loaded) return loaded.error();
          return loaded->scene;
        },
        peer_->program_end());
    ASSERT_TRUE(experiment.ok()) << experiment.error().message;
    options.experiment = *experiment;
  }
  void give(double stiffness, const std::string& more = "") {
    peer_->write(
        "{\"trial\":{\"a\":\"wall.stiffness_n_per_m=300\",\"b\":\"wall.stiffness_n_per_m=" +
        std::to_string(stiffness) + "\",\"correct\":\"b\"" + more + "}}\n");
    frames_until([&] { return !ui::awaits_trial(state().compare); });
  }
  void answer() {
    press(ImGuiKey_1);
    press(ImGuiKey_2);
    press(ImGuiMod_Ctrl | ImGuiKey_2);
  }
  [[nodiscard]] const ui::BlindTest& test() const { return *state().compare.transient.test; }
  [[nodiscard]] double stiffness() const { return scene().x().walls.front().stiffness_n_per_m; }
  [[nodiscard]] std::size_t stored() const {
    const std::size_t lines = lines_of(path("P1.csv")).size();
    return lines == 0 ? 0 : lines - 1;
  }

  std::unique_ptr<session::test::Peer> peer_;
};

TEST_F(PipedExperimentTest, RunsTrialAfterTrial) {
  const Scene before = scene();
  click("go on");
  EXPECT_THAT(text(), HasSubstr("The next trial is on its way"));
  answer();
  EXPECT_EQ(scene(), before) << "nothing is felt before a trial has come";
  EXPECT_EQ(stored(), 0U);
  give(900);
  EXPECT_THAT(text(), HasSubstr("trial 1"));
  press(ImGuiKey_1);
  const double first = stiffness();
  live(300);
  press(ImGuiKey_2);
  EXPECT_EQ(first + stiffness(), 300.0 + 900.0);
  press(ImGuiMod_Ctrl | ImGuiKey_2);
  EXPECT_EQ(stored(), 1U);
  static_cast<void>(peer_->messages(2));
  const auto answer_told = peer_->message("answer");
  EXPECT_EQ(answer_told["b.wall.stiffness_n_per_m"], "900");
  EXPECT_EQ(answer_told["lost_ticks"], "0");
  EXPECT_EQ(peer_->message("next"), 2);
  peer_->write("{\"end\":true}\n");
  frames_until([&] { return !ui::blind_test_runs(state().compare); });
  EXPECT_EQ(peer_->message("end"), "finished");
  EXPECT_EQ(test().results.tests.judged, 1U);
}

TEST_F(PipedExperimentTest, AnswersCarryTheExposureAndTheRecording) {
  click("go on");
  give(900, ",\"step\":4");
  fake_->advance(2000);
  frames(1);
  press(ImGuiKey_1);
  live(1000);
  ASSERT_FALSE(fake_->start_recording(path("r.csv")));
  press(ImGuiKey_2);
  live(500);
  const std::uint64_t last = newest().tick;
  press(ImGuiMod_Ctrl | ImGuiKey_1);
  const auto found =
      file::parse_answer(lines_of(path("P1.csv")).back(), *options.experiment->answers.columns());
  ASSERT_TRUE(found.has_value());
  EXPECT_THAT(found->extras, ElementsAre("4"));
  EXPECT_EQ(found->exposure.first_tick, 2000U);
  EXPECT_EQ(found->exposure.last_tick, last);
  EXPECT_EQ(found->exposure.recording, "r.csv");
}

TEST_F(PipedExperimentTest, ABreakWaitsAndAskingComesAfterIt) {
  click("go on");
  static_cast<void>(peer_->messages(2));
  peer_->write("{\"trial\":{\"kind\":\"break\",\"question\":\"Breathe.\"}}\n");
  frames_until([&] { return !ui::awaits_trial(state().compare); });
  EXPECT_THAT(text(), HasSubstr("Breathe."));
  click("go on");
  EXPECT_EQ(peer_->message("next"), 1);
  give(900);
  EXPECT_THAT(text(), HasSubstr("trial 1"));
}

TEST_F(PipedExperimentTest, AWrongLineIsShownAndAnswered) {
  click("go on");
  static_cast<void>(peer_->messages(2));
  peer_->write("{\"trial\":{\"a\":\"\",\"b\":\"wall.stiffness_n_per_m=-1\"}}\n");
  frames_until([&] { return !test().experiment->feed->problem().empty(); });
  EXPECT_THAT(text(), HasSubstr("A line of the program that gives the trials is wrong: b: --set"));
  EXPECT_THAT(std::string(peer_->message("error")), HasSubstr("out of range"));
  EXPECT_EQ(stiffness(), 35'000.0) << "that of press";
  give(900);
  EXPECT_THAT(text(), Not(HasSubstr("is wrong")));
}

TEST_F(PipedExperimentTest, AProgramThatLeavesIsToldAndARestartResumes) {
  click("go on");
  give(900);
  peer_->leave();
  answer();
  EXPECT_EQ(stored(), 1U) << "the trial that it gave is answered";
  frames_until([&] { return test().feed_left; });
  EXPECT_THAT(text(), HasSubstr("The program that gives the trials has ended."));
  application_.reset();
  prepare();
  open("press");
  EXPECT_EQ(peer_->message("hello")["answers"], 1);
  EXPECT_EQ(peer_->message("answer")["trial"], "1");
  EXPECT_EQ(peer_->message("next"), 2);
  click("go on");
  give(800);
  answer();
  EXPECT_EQ(stored(), 2U);
  click("stop and show");
  EXPECT_EQ(test().results.tests.judged, 2U);
}

TEST_F(PipedExperimentTest, TheStreamHearsOfEveryPresentation) {
  click("go on");
  give(900);
  answer();
  ASSERT_EQ(fake_->events.size(), 3U);
  EXPECT_THAT(fake_->events[0],
              HasSubstr("trial,\"trial\":1,\"what\":\"felt\",\"presentation\":1"));
  EXPECT_THAT(fake_->events[2], HasSubstr("\"what\":\"answered\",\"presentation\":2"));
}

TEST_F(PipedExperimentTest, NeverArmsADevice) {
  with_device = true;
  application_.reset();
  prepare();
  open("press");
  click("go on");
  give(900);
  answer();
  peer_->write("garbage\n");
  frames(5);
  give(700);
  answer();
  EXPECT_THAT(fake_->arm_requests, ElementsAre());
  EXPECT_EQ(fake_->resets, 0);
}

}  // namespace
}  // namespace hapticwall::test
