// The program gives the bytes of tests/determinism: runs every line of its table.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/file/disk/sha256.h"
#include "tests/app/command/binary.h"
#include "tests/paths.h"

namespace hapticwall::command::test {
namespace {

class Determinism : public ProgramTest {
 protected:
  struct Row {
    std::string sha256;
    std::vector<std::string> arguments;
  };

  static std::vector<Row> table() {
    std::ifstream file(hapticwall::test::data_folder() + "/determinism/hashes.txt");
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line.substr(0, line.find(", threads:")));
      Row& row = rows.emplace_back();
      words >> row.sha256;
      for (std::string word; words >> word;) row.arguments.push_back(word);
    }
    return rows;
  }

  [[nodiscard]] std::string sha256(const std::string& name) const {
    file::Sha256 digest;
    digest.update(content(name));
    return digest.finish();
  }
};

TEST_F(Determinism, TheProgramWritesTheBytesOfTheTable) {
  const std::vector<Row> rows = table();
  ASSERT_GE(rows.size(), 90U);
  for (Row row : rows) {
    std::string line;
    for (const std::string& word : row.arguments) line += word + " ";
    SCOPED_TRACE(line);
    row.arguments.insert(row.arguments.end(), {"--csv", "a.csv", "--quiet"});
    const Answer answer = hapticwall(row.arguments);
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(sha256("a.csv"), row.sha256);
    remove_files();
  }
}

}  // namespace
}  // namespace hapticwall::command::test
