// Trials through a pipe: the protocol, its checks, and peers that are silent, endless or gone.
#include "app/session/trial_feed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/file/scene/scene_file.h"
#include "app/session/experiment.h"
#include "tests/app/session/piped.h"
#include "tests/temporary_folder.h"

namespace hapticwall::session::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTrial =
    R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=1200","step":3,"correct":"b"}})"
    "\n";

class TrialFeedTest : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    reopen();
  }
  void reopen() {
    experiment_.reset();
    peer_ = std::make_unique<Peer>();
    auto opened = open_experiment(
        {kPiped, "P1", "1", path("out.csv")},
        [](std::span<const std::string> overrides) -> Result<Scene> {
          Result<file::LoadedScene> loaded = file::load_scene("press", overrides);
          if (!loaded) return loaded.error();
          return loaded->scene;
        },
        peer_->program_end());
    ASSERT_TRUE(opened) << opened.error().message;
    experiment_ = std::move(*opened);
  }
  // The next event that is not kNothing; the generous bound only catches a broken program.
  FeedEvent event() {
    for (int i = 0; i < 10'000; ++i) {
      const FeedEvent found = experiment_->feed->take(*experiment_);
      if (found != FeedEvent::kNothing) return found;
      experiment_->feed->wait(std::chrono::milliseconds{1});
    }
    return FeedEvent::kNothing;
  }
  // Handles one line.
  FeedEvent event_of_one_line() {
    experiment_->feed->wait(std::chrono::seconds{10});
    return experiment_->feed->take(*experiment_);
  }
  // Answers the newest trial as its participant would.
  void answer_newest() {
    const file::TrialSpec& trial = experiment_->trials.back();
    file::Answer answer;
    answer.trial = trial.number;
    answer.a = trial.slots[0];
    answer.b = trial.slots[1];
    answer.extras = trial.extras;
    answer.values = values_at(*experiment_, experiment_->trials.size() - 1);
    ASSERT_FALSE(experiment_->answers.append(answer));
    experiment_->feed->answered(*experiment_, answer);
    experiment_->feed->ask(*experiment_);
  }

  std::unique_ptr<Peer> peer_;
  std::shared_ptr<Experiment> experiment_;
};

TEST_F(TrialFeedTest, ATrialGoesInAndItsAnswerComesOut) {
  const auto hello = peer_->message("hello");
  EXPECT_EQ(hello["participant"], "P1");
  EXPECT_EQ(hello["answers"], 0);
  EXPECT_EQ(peer_->message("next"), 1);
  EXPECT_EQ(experiment_->feed->take(*experiment_), FeedEvent::kNothing) << "a silent peer";
  peer_->write(kTrial);
  ASSERT_EQ(event(), FeedEvent::kTrial);
  EXPECT_EQ(experiment_->scenes.front()[1].x().walls.front().stiffness_n_per_m, 1200.0);
  answer_newest();
  const auto answer = peer_->message("answer");
  EXPECT_EQ(answer["b.wall.stiffness_n_per_m"], "1200");
  EXPECT_EQ(answer["a.wall.stiffness_n_per_m"], "35000") << "of press, whose slot is empty";
  EXPECT_EQ(answer["step"], "3");
  EXPECT_EQ(peer_->message("next"), 2);
  peer_->write("{\"end\": true}\n");
  EXPECT_EQ(event(), FeedEvent::kEnd);
}

TEST_F(TrialFeedTest, ARestartHandsTheAnswersOverFirst) {
  peer_->write(kTrial);
  ASSERT_EQ(event(), FeedEvent::kTrial);
  answer_newest();
  const auto told = peer_->messages(4);  // hello, next, answer, next
  reopen();
  EXPECT_EQ(peer_->message("hello")["answers"], 1);
  EXPECT_EQ(peer_->message("answer"), told[2]["answer"]) << "the same as when it was given";
  EXPECT_EQ(peer_->message("next"), 2);
  ASSERT_EQ(experiment_->trials.size(), 1U);
}

// Each with the sentence that the peer gets.
TEST_F(TrialFeedTest, AWrongLineGetsOneLineAndChangesNothing) {
  static_cast<void>(peer_->messages(2));
  peer_->write(kTrial);
  ASSERT_EQ(event(), FeedEvent::kTrial);
  for (const auto& [line, why] : std::vector<std::pair<std::string, std::string>>{
           {"hello", "a line is no JSON"},
           {"\xff", "a line is not UTF-8"},
           {"[1]", "a line has another form"},
           {"{}", "a line has another form"},
           {R"({"trials":{}})", "'trials' is no message"},
           {R"({"end":false})", "'end' is no message"},
           {R"({"choose":1})", "choose: no trial waits for a simulated observer"},
           {R"({"trial":3})", "trial: it takes an object"},
           {R"({"trial":{"a":[1],"b":""}})", "trial: a: it takes a text or a number"},
           {R"({"trial":{"a":"","b":""}})", "a and b are both empty"},
           {R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=-1"}})", "b: --set"},
           {R"({"trial":{"a":"","b":"sampling.rate_hz=500"}})", "the first trial sets no such key"},
           {R"({"trial":{"a":"","b":"device.mass_kg=1"}})", "the first trial sets no such key"},
           {R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=3","other":1}})",
            "other: the first trial has no such column"},
           {R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=3","step":"\u001b[2J"}})",
            "step: it has a control character"},
           {R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=3","trial":1}})",
            "trial: 1 was given before"},
           {R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=3","kind":"tset"}})", "kind: 'tset'"},
           {std::string(file::kMaxMessageBytes + 5, 'x'), "a line is longer than 16384 bytes"}}) {
    peer_->write(line + "\n");
    EXPECT_EQ(event_of_one_line(), FeedEvent::kNothing);
    const std::string error = peer_->message("error");
    EXPECT_THAT(error, HasSubstr(why)) << line.substr(0, 80);
    EXPECT_EQ(experiment_->feed->problem(), error);
    EXPECT_EQ(experiment_->trials.size(), 1U);
  }
  peer_->write(kTrial);
  EXPECT_EQ(event(), FeedEvent::kTrial) << "a right one is taken after them";
  EXPECT_EQ(experiment_->feed->problem(), "");
}

TEST_F(TrialFeedTest, APeerThatLeavesIsTold) {
  peer_->write(kTrial);
  peer_->write(R"({"trial":{"a":"","b")");
  peer_->leave();
  EXPECT_EQ(event(), FeedEvent::kTrial) << "its whole lines count";
  EXPECT_EQ(event(), FeedEvent::kLeft) << "a torn one does not";
  EXPECT_EQ(event(), FeedEvent::kLeft);
}

TEST_F(TrialFeedTest, APeerThatReadsNothingChangesNothing) {
  peer_->read_no_more();
  peer_->write("wrong\n");
  peer_->write(kTrial);
  EXPECT_EQ(event(), FeedEvent::kTrial);
  answer_newest();
  EXPECT_EQ(experiment_->answers.columns()->extras, std::vector<std::string>{"step"});
}

// Writes until the pipe takes nothing for a while, at most 8 MiB. Returns the bytes that it took.
std::size_t flood(int writing_end, const std::string& text) {
  constexpr std::size_t kMax = std::size_t{8} << 20U;
  EXPECT_EQ(fcntl(writing_end, F_SETFL, O_NONBLOCK), 0);
  std::size_t taken = 0;
  for (int refused = 0; refused < 50 && taken < kMax;) {
    const ssize_t bytes = write(writing_end, text.data(), text.size());
    if (bytes > 0) taken += static_cast<std::size_t>(bytes);
    refused = bytes > 0 ? 0 : refused + 1;
    if (bytes <= 0) usleep(1000);
  }
  return taken;
}

TEST_F(TrialFeedTest, EndlessLinesWaitInThePipe) {
  EXPECT_LT(flood(peer_->writing_end(), std::string(2047, 'y') + "\n"), std::size_t{1} << 20U);
  EXPECT_EQ(experiment_->feed->take(*experiment_), FeedEvent::kNothing);
  EXPECT_TRUE(experiment_->trials.empty());
}

TEST_F(TrialFeedTest, ALineWithoutAnEndIsDroppedAsItComes) {
  EXPECT_GE(flood(peer_->writing_end(), std::string(4096, 'y')), std::size_t{8} << 20U);
  EXPECT_EQ(experiment_->feed->take(*experiment_), FeedEvent::kNothing);
  EXPECT_TRUE(experiment_->trials.empty());
}

TEST_F(TrialFeedTest, ABreakHasNoNumberAndNoAnswer) {
  static_cast<void>(peer_->messages(2));
  peer_->write("{\"trial\":{\"kind\":\"break\",\"question\":\"Rest.\"}}\n");
  peer_->write(kTrial);
  ASSERT_EQ(event(), FeedEvent::kTrial);
  EXPECT_EQ(experiment_->trials.back().question, "Rest.");
  ASSERT_EQ(event(), FeedEvent::kTrial);
  EXPECT_EQ(experiment_->trials.back().number, 1U);
}

}  // namespace
}  // namespace hapticwall::session::test
