// An interrupted recording: no row is lost or overwritten, and it can be finished.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"
#include "tests/app/command/no_room.h"

namespace hapticwall::command::test {
namespace {

using ::testing::AnyOf;
using ::testing::MatchesRegex;

constexpr std::uintmax_t kSomeRows = 2000;  // bytes of a recording with its header

class RecoverCommand : public ProgramTest {
 protected:
  // Starts a recording and kills it when it has written so much.
  void kill_a_run(std::vector<std::string> arguments, std::uintmax_t bytes) const {
    arguments.insert(arguments.begin(), {program(), "run"});
    const pid_t child = start(arguments);
    wait_until_written(child, "a.csv.partial", bytes);
    kill(child, SIGKILL);
    ASSERT_EQ(wait_for(child).status, 128 + SIGKILL);
    // The last name is of a note that the kill left incomplete.
    ASSERT_THAT(files(),
                AnyOf(ElementsAre("a.csv.partial", "a.toml.partial"),
                      ElementsAre("a.csv.partial", "a.toml.partial", "a.toml.partial.partial")));
  }
};

TEST_F(RecoverCommand, EveryWholeRowSurvivesAKillAtAnyMomentAndRepeats) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uintmax_t> bytes(kSomeRows, 1'000'000);
  constexpr int kKills = 100;
  for (int i = 0; i < kKills; ++i) {
    kill_a_run({"press", "--duration", "100000", "--csv", "a.csv", "--quiet"}, bytes(random));
    const std::string partial = content("a.csv.partial");
    const Answer answer = hapticwall({"recover", "a.csv"});
    ASSERT_EQ(answer.status, 0) << answer.err;
    ASSERT_THAT(files(), ElementsAre("a.csv", "a.toml"));
    const std::string csv = content("a.csv");
    // Only a broken last line is removed.
    ASSERT_TRUE(partial.starts_with(csv));
    ASSERT_EQ(partial.find('\n', csv.size()), std::string::npos);
    ASSERT_TRUE(csv.ends_with('\n'));
    const auto rows = std::count(csv.begin(), csv.end(), '\n') - 1;
    ASSERT_THAT(answer.out, StartsWith("a.csv: " + std::to_string(rows) + " rows"));
    ASSERT_THAT(content("a.toml"), AllOf(HasSubstr("rows = " + std::to_string(rows) + "\n"),
                                         HasSubstr("complete = true\nrecovered = true\n"),
                                         HasSubstr("repeatable = true")));
    if (i % 10 == 0) {
      ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "b.csv", "--quiet"}).status, 0);
      ASSERT_TRUE(content("b.csv") == csv);
    }
    remove_files();
  }
}

TEST_F(RecoverCommand, ASessionInRealTimeIsRecoveredToo) {
  std::mt19937 random(11);
  std::uniform_int_distribution<std::uintmax_t> bytes(kSomeRows, 80'000);
  for (int i = 0; i < 5; ++i) {
    kill_a_run({"tap", "--duration", "100", "--realtime", "--csv", "a.csv", "--quiet"},
               bytes(random));
    const Answer answer = hapticwall({"recover", "a.csv.partial"});
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_THAT(answer.out, MatchesRegex("a.csv: [0-9]+ rows.*\n"));
    ASSERT_THAT(files(), ElementsAre("a.csv", "a.toml"));
    EXPECT_THAT(content("a.toml"), HasSubstr("start_time = "));
    ASSERT_EQ(hapticwall({"run", "a.toml", "--csv", "b.csv", "--quiet"}).status, 0);
    EXPECT_TRUE(content("b.csv") == content("a.csv"));
    remove_files();
  }
}

TEST_F(RecoverCommand, RemainsOfARecordingAreNotOverwritten) {
  ASSERT_EQ(shell("ulimit -f 8; exec $P run press --csv a.csv --quiet").status, 4);
  const std::string partial = content("a.csv.partial");
  EXPECT_EQ(hapticwall({"run", "press", "--csv", "a.csv"}).status, 4);
  EXPECT_EQ(content("a.csv.partial"), partial);
  // The written part is recovered.
  ASSERT_EQ(hapticwall({"recover", "a.csv"}).status, 0);
  EXPECT_TRUE(partial.starts_with(content("a.csv")));
  EXPECT_EQ(hapticwall({"run", "press", "--csv", "c.csv", "--quiet"}).status, 0);
}

TEST_F(RecoverCommand, AFullDiskTakesNothingFromIt) {
  if (!kStartsWithoutRoom) GTEST_SKIP();
  kill_a_run({"press", "--duration", "100000", "--csv", "a.csv", "--quiet"}, kSomeRows);
  const std::string rows = content("a.csv.partial");
  const std::string note = content("a.toml.partial");
  EXPECT_EQ(shell(std::string(kNoRoom) + "recover a.csv").status, 4);
  EXPECT_TRUE(content("a.csv.partial") == rows);
  EXPECT_EQ(content("a.toml.partial"), note);
  EXPECT_EQ(hapticwall({"recover", "a.csv"}).status, 0);
}

TEST_F(RecoverCommand, AChangeThatNobodyKnowsIsTold) {
  ASSERT_EQ(hapticwall({"run", "press", "--duration", "0.1", "--csv", "b.csv", "--quiet"}).status,
            0);
  std::string csv = content("b.csv");
  // Marks a row as a change of parameters: flags 0 become 16.
  const std::size_t row = csv.find("\n20,0.02,");
  const std::size_t flags = csv.find(",0,0.03", csv.find(",-0.02", row));
  ASSERT_NE(flags, std::string::npos);
  csv.replace(flags, 2, ",16");
  put("a.csv.partial", csv);
  ASSERT_EQ(shell("grep -v csv_sha256 b.toml > a.toml.partial").status, 0);
  const Answer answer = hapticwall({"recover", "a.csv"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err,
              HasSubstr("note: 'run' will not repeat it: parameters changed at tick 20, "));
  EXPECT_THAT(content("a.toml"), HasSubstr("repeatable = false"));
}

TEST_F(RecoverCommand, ARecordingThatRunsIsLeftAlone) {
  const pid_t child = start(
      {program(), "run", "press", "--duration", "1000", "--realtime", "--csv", "a.csv", "--quiet"});
  wait_until_written(child, "a.csv.partial");
  const pid_t second = start({program(), "recover", "a.csv"});
  EXPECT_EQ(wait_for(second).status, 4);
  kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child).status, 143);
  EXPECT_THAT(files(), ElementsAre("a.csv", "a.toml"));
}

}  // namespace
}  // namespace hapticwall::command::test
