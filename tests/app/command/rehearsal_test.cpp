// hapticwall --trials - --rehearse: the protocol at the program's own pipes, without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kRehearse =
    "$P press --trials - --rehearse --participant P1 --answers o.csv <in.jsonl";

class RehearsalTest : public ProgramTest {
 protected:
  // The names of the messages, and the messages.
  std::vector<std::string> run(const std::string& lines, const std::string& command = kRehearse) {
    put("in.jsonl", lines);
    answer_ = shell(command);
    messages_.clear();
    std::vector<std::string> names;
    std::istringstream out(answer_.out);
    for (std::string line; std::getline(out, line);) {
      messages_.push_back(nlohmann::json::parse(line));
      names.push_back(messages_.back().begin().key());
    }
    return names;
  }

  Answer answer_;
  std::vector<nlohmann::json> messages_;
};

constexpr const char* kTrial =
    R"({"trial":{"a":"wall.stiffness_n_per_m=1000","b":"wall.stiffness_n_per_m=2000","correct":"b"}})"
    "\n";

// Lines may come before they are asked for.
TEST_F(RehearsalTest, EveryLineHasItsAnswer) {
  EXPECT_THAT(run(std::string(kTrial) + "{\"choose\":1}\nwrong\n" + kTrial +
                  "{\"choose\":2}\n{\"end\":true}\n"),
              ElementsAre("hello", "next", "felt", "answer", "next", "error", "felt", "answer",
                          "next", "end"));
  EXPECT_EQ(answer_.status, 0) << answer_.err;
  EXPECT_EQ(answer_.err, "");
  EXPECT_EQ(messages_[3]["answer"]["chosen_presentation"], "1");
  EXPECT_EQ(messages_[7]["answer"]["chosen_presentation"], "2");
  EXPECT_EQ(messages_.back()["end"], "finished");
  // The softer wall lets the same hand in deeper, with less force.
  const auto& felt = messages_[2]["felt"];
  const std::size_t soft = felt["first"] == "A" ? 0 : 1;
  EXPECT_LT(felt["exposures"][soft]["max_force_n"], felt["exposures"][1 - soft]["max_force_n"]);
}

TEST_F(RehearsalTest, ItResumesAfterAnEndThatNobodyAsked) {
  run(std::string(kTrial) + "{\"choose\":1}\n" + kTrial);
  EXPECT_EQ(answer_.status, 4);
  EXPECT_THAT(answer_.err, HasSubstr("the other program has ended before {\"end\": true}"));
  EXPECT_EQ(messages_.back()["end"], "closed");
  const auto told = messages_[3];
  EXPECT_THAT(run("{\"end\":true}\n"), ElementsAre("hello", "answer", "next", "end"));
  EXPECT_EQ(messages_[1], told);
  EXPECT_EQ(messages_[2]["next"], 2);
}

TEST_F(RehearsalTest, AHandThatFollowsTheMouseIsRefused) {
  run(kTrial, std::string(kRehearse) + " --set hand.path='\"mouse\"'");
  EXPECT_EQ(answer_.status, 2);
  EXPECT_THAT(answer_.err, HasSubstr("--rehearse: a hand that follows the mouse"));
}

TEST_F(RehearsalTest, ADeviceIsRefused) {
  run(kTrial, std::string(kRehearse) + " --device ie2000");
  EXPECT_EQ(answer_.status, 2);
  EXPECT_THAT(answer_.err, HasSubstr("--rehearse: it runs on the simulator alone"));
}

}  // namespace
}  // namespace hapticwall::command::test
