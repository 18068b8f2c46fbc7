// Re-runs of a recorded hand, drawn over the plots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "app/session/hand_rerun.h"
#include "tests/app/ui/replay_support.h"

namespace hapticwall::test {
namespace {

using draw::ExtraTrace;
using ::testing::HasSubstr;

class ReplayRerunTest : public ReplayGuiTest {
 protected:
  void SetUp() override {
    ReplayGuiTest::SetUp();
    record("trial.csv", 900);
    drop("trial.csv");
    ASSERT_TRUE(replaying());
  }
  [[nodiscard]] const std::vector<ExtraTrace>& traces() {
    return state().plots.transient.extra_traces;
  }
  void wait_for_rerun() {
    frames_until([&] { return !state().replay.rerun.running(); });
    frames(2);
  }
  // The result of `hapticwall replay --algorithm`.
  [[nodiscard]] std::vector<Sample> rerun(const std::string& algorithm) {
    std::vector<Sample> samples;
    const auto reader = file::RecordingReader::open(path("trial.csv"));
    const auto scene = session::rerun_scene((*reader)->info(), algorithm, {});
    session::RerunOptions told;
    told.on_sample = [&](const Sample& sample) { samples.push_back(sample); };
    EXPECT_TRUE(session::rerun_hand(**reader, *scene, told));
    return samples;
  }
};

TEST_F(ReplayRerunTest, IsChosenFromTheListAndIsWhatTheCommandComputes) {
  click("re-run");
  click("re-run none");
  wait_for_rerun();
  ASSERT_NE(replay().overlay(), nullptr) << message().text;
  EXPECT_EQ(replay().overlay()->label, "none");
  const std::vector<Sample> expected = rerun("none");
  const std::vector<Sample>& laid = replay().overlay()->samples;
  ASSERT_EQ(laid.size(), expected.size());
  ASSERT_EQ(traces().size(), 1U);
  const draw::SampleHistory& history = *traces().front().history;
  ASSERT_EQ(history.size(), expected.size());
  bool differs = false;
  pass_ms(899);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(laid[i].position_m, expected[i].position_m);
    ASSERT_EQ(history.value(&Sample::force_n, i), expected[i].force_n);
    differs = differs || application_->history().value(&Sample::force_n, i) != expected[i].force_n;
  }
  EXPECT_TRUE(differs) << "another algorithm";
  EXPECT_TRUE(sees("under none"));
}

TEST_F(ReplayRerunTest, TheKeyOfAnAlgorithmDoesItAndTheNextOneReplacesIt) {
  press(ImGuiKey_1);
  wait_for_rerun();
  ASSERT_NE(replay().overlay(), nullptr);
  const std::string first = replay().overlay()->label;
  press(ImGuiKey_2);
  wait_for_rerun();
  EXPECT_NE(replay().overlay()->label, first);
  EXPECT_EQ(traces().size(), 1U);
  EXPECT_EQ(traces().front().label, "under " + replay().overlay()->label);
}

TEST_F(ReplayRerunTest, IsTakenAwayByHandAndWithTheRecording) {
  press(ImGuiKey_1);
  wait_for_rerun();
  ASSERT_EQ(traces().size(), 1U);
  click("re-run");
  click("re-run nothing");
  EXPECT_EQ(replay().overlay(), nullptr);
  EXPECT_TRUE(traces().empty());
  press(ImGuiKey_1);
  wait_for_rerun();
  ASSERT_EQ(traces().size(), 1U);
  click("back to the scene");
  EXPECT_TRUE(traces().empty());
}

TEST_F(ReplayRerunTest, AFileThatHasChangedSinceIsToldAndNothingIsLaidOver) {
  std::filesystem::rename(path("trial.csv"), path("old.csv"));
  record("trial.csv", 500);
  press(ImGuiKey_1);
  wait_for_rerun();
  EXPECT_EQ(replay().overlay(), nullptr);
  EXPECT_THAT(message().text, HasSubstr("not the file any more that was opened"));
}

// Its scene has the script alone.
TEST_F(ReplayGuiTest, OfALedHandTheModelDoesNotRun) {
  record("led.csv", 300);
  std::string sidecar = content("led.toml");
  const std::string repeatable = "repeatable = true";
  ASSERT_NE(sidecar.find(repeatable), std::string::npos);
  put("led.toml", sidecar.replace(sidecar.find(repeatable), repeatable.size(),
                                  "repeatable = false\nnot_repeatable_because = \"led\""));
  drop("led.csv");
  ASSERT_TRUE(replaying());
  for (const char* page : {"page Map", "page All at once"}) {
    click(page);
    frames(3);
    EXPECT_THAT(text(), HasSubstr("not the recorded hand")) << page;
  }
}

}  // namespace
}  // namespace hapticwall::test
