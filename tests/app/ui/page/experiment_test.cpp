// An experiment in the window: its page, its safety, and what it must not reveal.
#include "app/session/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

#include "app/ui/state/blind_test.h"
#include "hapticwall_version.h"
#include "tests/app/ui/gui_test.h"
#include "tests/paths.h"

namespace hapticwall::test {
namespace {

using compare::Slot;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kTwoWalls =
    "trial,kind,a,b,question,correct\n"
    "1,practice,wall.stiffness_n_per_m=300,wall.stiffness_n_per_m=900,Which is stiffer?,b\n"
    "2,break,,,Breathe.,\n"
    "3,test,wall.stiffness_n_per_m=300,wall.stiffness_n_per_m=900; algorithm=none,Stiffer?,b\n"
    "4,catch,wall.stiffness_n_per_m=300,wall.stiffness_n_per_m=300,Stiffer?,\n";

class ExperimentPageTest : public GuiTest {
 protected:
  void SetUp() override {
    prepare(kTwoWalls);
    GuiTest::SetUp();
  }
  void prepare(const std::string& list, const std::string& participant = "P1") {
    put("list.csv", list);
    options.experiment.reset();  // the last owner closes the answers
    const auto experiment =
        session::open_experiment({path("list.csv"), participant, "1", path(participant + ".csv")},
                                 [](std::span<const std::string> overrides) -> Result<Scene> {
                                   return file::load_scene("press", overrides)->scene;
                                 });
    ASSERT_TRUE(experiment.ok()) << experiment.error().message;
    options.experiment = *experiment;
  }
  // Repeats the same command, as after a kill.
  void restart(const std::string& list = kTwoWalls, const std::string& participant = "P1") {
    application_.reset();
    prepare(list, participant);
    open("press");
  }
  void answer() {
    press(ImGuiKey_1);
    press(ImGuiKey_2);
    press(ImGuiMod_Ctrl | ImGuiKey_2);
  }
  [[nodiscard]] const ui::BlindTest& test() const { return *state().compare.transient.test; }
  [[nodiscard]] double stiffness() const { return scene().x().walls.front().stiffness_n_per_m; }
  [[nodiscard]] std::size_t stored() const { return lines_of(path("P1.csv")).size() - 1; }
};

TEST_F(ExperimentPageTest, PlaysItsListToTheEnd) {
  const Scene before = scene();
  EXPECT_THAT(text(), HasSubstr("list, participant P1, session 1"));
  press(ImGuiKey_1);
  EXPECT_EQ(scene(), before) << "nothing is felt before it begins";
  click("go on");
  EXPECT_THAT(text(), HasSubstr("practice, trial 1 of 3"));
  press(ImGuiKey_1);
  const double first = stiffness();
  press(ImGuiKey_2);
  EXPECT_EQ(first + stiffness(), 300.0 + 900.0);
  click("choose first");
  EXPECT_EQ(stored(), 1U) << "stored at once";
  EXPECT_THAT(text(), HasSubstr("Breathe."));
  const Scene in_break = scene();
  answer();
  EXPECT_EQ(stored(), 1U) << "a break waits";
  EXPECT_EQ(scene(), in_break);
  click("go on");
  answer();
  EXPECT_THAT(text(), HasSubstr("trial 3 of 3"));
  EXPECT_THAT(text(), ::testing::Not(HasSubstr("catch")));
  answer();
  EXPECT_FALSE(test().running);
  EXPECT_EQ(stored(), 3U);
  EXPECT_EQ(stiffness(), 300.0) << "no stiffer wall comes while somebody presses";
  EXPECT_EQ(state().scene.undo.size(), 2U) << "all its walls are one step";
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(scene(), before);
  EXPECT_EQ(test().results.practice, 1U);
  EXPECT_EQ(test().results.tests.judged, 1U);
  EXPECT_EQ(test().results.pairs.size(), 2U);
  EXPECT_TRUE(sees("correct"));
}

// The first block of this kind in docs/experiments.md, and the example.
TEST_F(ExperimentPageTest, TheDocumentedListsArePlayedToTheEnd) {
  const std::string root = data_folder() + "/../";
  const std::string page = text_of(root + "docs/experiments.md");
  const std::string fence = "```csv short.csv\n";
  const std::size_t from = page.find(fence) + fence.size();
  for (const std::string& list : {page.substr(from, page.find("```", from) - from),
                                  text_of(root + "assets/examples/experiments/stiffer.csv")}) {
    std::filesystem::remove(path("P1.csv"));
    restart(list);
    while (ui::blind_test_runs(state().compare)) {
      if (ui::waits(test())) {
        click("go on");
      } else {
        answer();
      }
    }
    EXPECT_GT(stored(), 4U);
    EXPECT_EQ(stored(), test().trials.planned());
    EXPECT_GT(test().results.catches.judged, 0U);
  }
  EXPECT_EQ(test().results.pairs.size(), 9U);
}

TEST_F(ExperimentPageTest, ALineHasAllThatIsKnown) {
  click("go on");
  answer();
  const auto& identity = options.experiment->answers.identity();
  const auto answer =
      file::parse_answer(lines_of(path("P1.csv")).back(), *options.experiment->answers.columns());
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->participant, "P1");
  EXPECT_EQ(answer->session, "1");
  EXPECT_EQ(answer->trial, 1U);
  EXPECT_EQ(answer->a, "wall.stiffness_n_per_m=300");
  EXPECT_EQ(answer->looks, 2U);
  EXPECT_GT(answer->seconds, 0.0);
  EXPECT_EQ(answer->correct, answer->chosen == Slot::kB);
  EXPECT_THAT(answer->time_utc, ::testing::EndsWith("Z"));
  EXPECT_EQ(answer->seed, identity.seed);
  EXPECT_EQ(answer->scene_sha256.size(), 64U);
  EXPECT_EQ(answer->list_sha256, identity.list_sha256);
  EXPECT_THAT(answer->program, HasSubstr(kVersion));
}

// A person who has never pressed "More" has no page of this name.
TEST_F(ExperimentPageTest, TheResultIsShownInTheFirstMinute) {
  shows_everything = false;
  restart();
  EXPECT_TRUE(sees("go on"));
  click("stop and show");
  frames(3);
  EXPECT_TRUE(sees("catch trials"));
  EXPECT_FALSE(sees("plot Position"));
  click("new blind test");
  frames(3);
  EXPECT_TRUE(sees("plot Position"));
}

TEST_F(ExperimentPageTest, ARestartGoesOnAfterTheLastStoredTrial) {
  click("go on");
  answer();
  click("go on");
  press(ImGuiKey_1);
  restart();
  EXPECT_EQ(test().trials.trial(), 1U);
  EXPECT_TRUE(ui::waits(test()));
  click("go on");
  EXPECT_TRUE(test().trials.at_break()) << "the break comes again";
  click("go on");
  answer();
  answer();
  EXPECT_FALSE(test().running);
  restart();
  EXPECT_FALSE(ui::blind_test_runs(state().compare)) << "all were answered: the result is shown";
  EXPECT_EQ(test().results.pairs.size(), 2U);
  EXPECT_EQ(stored(), 3U);
}

TEST_F(ExperimentPageTest, AnAnswerThatCannotBeStoredDoesNotCount) {
  click("go on");
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  rlimit full = limit;
  full.rlim_cur = std::filesystem::file_size(path("P1.csv"));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &full), 0);
  answer();
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("cannot be written"));
  EXPECT_EQ(test().trials.trial(), 0U);
  EXPECT_EQ(stored(), 0U);
  press(ImGuiMod_Ctrl | ImGuiKey_2);
  EXPECT_EQ(test().trials.trial(), 1U);
  EXPECT_EQ(stored(), 1U);
}

TEST_F(ExperimentPageTest, ATornLineIsTold) {
  click("go on");
  answer();
  application_.reset();
  options.experiment.reset();
  put("P1.csv", content("P1.csv") + "P1,1,2026-");
  restart();
  EXPECT_THAT(message().text, HasSubstr("its last line was torn and is dropped"));
  EXPECT_EQ(test().trials.trial(), 1U);
}

// Slots that differ in everything the picture could show: where the wall stands, the force limit.
TEST_F(ExperimentPageTest, TwoWallsLookTheSame) {
  const std::string list =
      "a,b\nwall.position_m=0.03; wall.stiffness_n_per_m=100; device.force_limit_n=1; "
      "algorithm=none,"
      "wall.stiffness_n_per_m=35000\n";
  const auto picture_of = [&](Slot wanted) {
    for (int person = 1;; ++person) {
      restart(list, "P" + std::to_string(person));
      const auto& trials = test().trials;
      compare::BlindTrials copy = trials;
      if (copy.present(compare::Presentation::kFirst, 0.0) == wanted) break;
    }
    click("go on");
    press(ImGuiKey_R);
    press(ImGuiKey_1);
    EXPECT_EQ(scene().x().walls.front().position_m == 0.03, wanted == Slot::kA);
    live(1500);
    EXPECT_NE(newest().force_n, 0.0) << "in contact";
    move_away();
    return screen();
  };
  static_cast<void>(picture_of(Slot::kA));  // the letters of this page are drawn for the first time
  const file::Picture a = picture_of(Slot::kA);
  const file::Picture b = picture_of(Slot::kB);
  EXPECT_LE(pixels_that_differ(a, b), kGlyphEdge);
}

TEST_F(ExperimentPageTest, EqualWallsOfACatchTrialLookLikeOthersAlsoInAPause) {
  click("go on");
  answer();
  click("go on");
  answer();
  press(ImGuiKey_P);
  fake_->echoes = false;
  press(ImGuiKey_1);
  const std::string first = text();
  press(ImGuiKey_2);
  press(ImGuiKey_1);
  EXPECT_EQ(scene().x().walls.front().stiffness_n_per_m, 300.0);
  EXPECT_THAT(first, HasSubstr("paused"));
  EXPECT_THAT(first, ::testing::Not(HasSubstr("asked for")));
}

TEST_F(ExperimentPageTest, NeverArmsADevice) {
  with_device = true;
  restart();
  click("go on");
  answer();
  click("go on");
  answer();
  answer();
  EXPECT_FALSE(test().running);
  EXPECT_THAT(fake_->arm_requests, ElementsAre());
  EXPECT_EQ(fake_->resets, 0);
}

}  // namespace
}  // namespace hapticwall::test
