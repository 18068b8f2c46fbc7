// User errors: every row of wrong_inputs.txt gives its status and its one-line message, and leaves
// no files.
#include "tests/app/command/wrong_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"
#include "tests/paths.h"

namespace hapticwall::command::test {
namespace {

const std::vector<WrongInput>& wrong_inputs() {
  static const std::vector<WrongInput> kRows =
      read_wrong_inputs(hapticwall::test::data_folder() + "/app/command/wrong_inputs.txt");
  return kRows;
}

std::vector<std::string> sections() {
  std::vector<std::string> names;
  for (const WrongInput& row : wrong_inputs()) {
    if (names.empty() || names.back() != row.section) names.push_back(row.section);
  }
  return names;
}

// Messages hold no terminal commands.
bool has_control_character(const std::string& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto code = static_cast<unsigned char>(line[i]);
    const bool upper = code == 0xc2U && static_cast<unsigned char>(line[i + 1]) < 0xa0U;
    if (code < 0x20U || code == 0x7fU || upper) return true;
  }
  return false;
}

class WrongInputs : public ProgramTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void check(const WrongInput& row) const {
    for (const GivenFile& file : row.files) put(file.name, file.text);
    const std::vector<std::string> before = files();
    const Answer answer = hapticwall(row.arguments);
    EXPECT_EQ(answer.status, row.status);
    EXPECT_EQ(answer.err, "error: " + row.sentence + "\n");
    EXPECT_FALSE(has_control_character(row.sentence));
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_EQ(files(), before);
    for (const GivenFile& file : row.files) {
      EXPECT_EQ(content(file.name), file.text);
      std::filesystem::remove(path(file.name));
    }
  }
};

TEST_P(WrongInputs, GetTheirSentences) {
  for (const WrongInput& row : wrong_inputs()) {
    if (row.section != GetParam()) continue;
    SCOPED_TRACE("line " + std::to_string(row.line) + ": " + row.name);
    check(row);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, WrongInputs, ::testing::ValuesIn(sections()), [](const auto& section) {
  std::string name;
  bool capital = true;
  for (const char c : section.param) {
    if (c != ' ') name += capital ? static_cast<char>(std::toupper(c)) : c;
    capital = c == ' ';
  }
  return name;
});

TEST(WrongInputTable, HasSomeHundredsOfThemEachOfItsOwn) {
  constexpr std::size_t kFewest = 300;
  std::set<std::vector<std::string>> seen;
  for (const WrongInput& row : wrong_inputs()) {
    std::vector<std::string> key = row.arguments;
    for (const GivenFile& file : row.files) key.insert(key.end(), {file.name, file.text});
    EXPECT_TRUE(seen.insert(key).second) << "line " << row.line << ": " << row.name;
  }
  EXPECT_GE(seen.size(), kFewest);
}

}  // namespace
}  // namespace hapticwall::command::test
