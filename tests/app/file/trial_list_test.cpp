// Trial lists: what a row may say. The messages to wrong lists are in tests/app/command.
#include "app/file/trials/trial_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "tests/paths.h"

namespace hapticwall::file {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CsvFields, AreThoseThatCsvFieldHasWritten) {
  for (const std::vector<std::string>& fields :
       {std::vector<std::string>{""}, {"", ""}, {"a", "b, c", "\"d\""}, {"\"", ",", "\"\",\""}}) {
    std::string line;
    for (const std::string& field : fields)
      line += (&field == fields.data() ? "" : ",") + csv_field(field);
    EXPECT_EQ(csv_fields(line), fields) << line;
  }
  for (const char* wrong : {"\"a", "a\"b", "\"a\"b", "\"a\"\"", "a,\"", "\"a\" ,b"})
    EXPECT_EQ(csv_fields(wrong), std::nullopt) << wrong;
}

TEST(TrialList, ARowHasItsFieldsInAnyOrderOfColumns) {
  const auto list = parse_trial_list(
      "\xEF\xBB\xBFkind,b,a,correct,question,block,trial\r\n"
      "catch,wall.stiffness_n_per_m=1200,\"wall.stiffness_n_per_m=1000; algorithm=none\",b,"
      "\"Which, then?\",one,7\r\n\r\n"
      "break,,,,Breathe,,8\r\n",
      "list.csv");
  ASSERT_TRUE(list) << list.error().message;
  ASSERT_EQ(list->trials.size(), 2U);
  const TrialSpec& trial = list->trials.front();
  EXPECT_EQ(trial.number, 7U);
  EXPECT_EQ(trial.block, "one");
  EXPECT_EQ(trial.kind, TrialKind::kCatch);
  EXPECT_EQ(trial.question, "Which, then?");
  EXPECT_EQ(trial.correct, Slot::kB);
  EXPECT_EQ(trial.line, 2U);
  EXPECT_THAT(slot_overrides(trial.slots[0]),
              ElementsAre("wall.stiffness_n_per_m=1000", "algorithm=none"));
  EXPECT_EQ(list->trials.back().question, "Breathe");
  EXPECT_EQ(list->trials.back().line, 4U);
}

TEST(TrialList, TwoColumnsAreEnough) {
  const auto list = parse_trial_list("a,b\n,device.mass_kg=0.1\n", "list.csv");
  ASSERT_TRUE(list) << list.error().message;
  const TrialSpec& trial = list->trials.front();
  EXPECT_EQ(trial.number, 1U);
  EXPECT_EQ(trial.kind, TrialKind::kTest);
  EXPECT_EQ(trial.question, kUsualQuestion);
  EXPECT_EQ(trial.correct, std::nullopt);
  EXPECT_TRUE(slot_overrides(trial.slots[0]).empty());
}

TEST(TrialList, FurtherColumnsAreCarriedUnchanged) {
  const auto list = parse_trial_list(
      "level,a,b,Größe\n 3 ,,device.mass_kg=0.1,\"x,y\"\n,,device.mass_kg=1,\n", "list.csv");
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_THAT(list->extras, ElementsAre("level", "Größe"));
  EXPECT_THAT(list->trials[0].extras, ElementsAre(" 3 ", "x,y"));
  EXPECT_THAT(list->trials[1].extras, ElementsAre("", ""));
}

TEST(TrialList, ANameThatIsNearlyAColumnIsASlipIfTheListLacksThatColumn) {
  EXPECT_THAT(parse_trial_list("a,b,kimd\n,device.mass_kg=1,\n", "l").error().message,
              HasSubstr("'kimd' is no column; did you mean 'kind'?"));
  EXPECT_TRUE(parse_trial_list("a,b,kind,kimd,k\n,device.mass_kg=1,,,\n", "l"));
}

TEST(TrialList, ItsHashIsThatOfItsBytes) {
  const auto one = parse_trial_list("a,b\n,device.mass_kg=0.1\n", "");
  const auto other = parse_trial_list("a,b\n,device.mass_kg=0.2\n", "");
  EXPECT_EQ(one->sha256.size(), 64U);
  EXPECT_NE(one->sha256, other->sha256);
}

TEST(TrialList, HasABound) {
  std::string text = "a,b\n";
  for (std::size_t i = 0; i < kMaxTrials; ++i) text += ",device.mass_kg=0.1\n";
  EXPECT_TRUE(parse_trial_list(text, "list.csv"));
  EXPECT_THAT(parse_trial_list(text + ",device.mass_kg=0.1\n", "list.csv").error().message,
              HasSubstr("list.csv:1002: more than 1000 trials"));
}

TEST(TrialList, TheExampleIsOne) {
  const auto list = read_trial_list(hapticwall::test::data_folder() +
                                    "/../assets/examples/experiments/stiffer.csv");
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_EQ(list->trials.size(), 55U);
}

}  // namespace
}  // namespace hapticwall::file
