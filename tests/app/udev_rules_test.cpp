// What assets/70-hapticwall.rules must and must not allow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace hapticwall {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::string> rules() {
  std::ifstream file(HAPTICWALL_TEST_DATA_DIR "/../assets/70-hapticwall.rules");
  EXPECT_TRUE(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.front() != '#') lines.push_back(line);
  }
  return lines;
}

TEST(UdevRules, LetThoseAtTheMachineInAndNobodyElse) {
  const std::vector<std::string> lines = rules();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], StartsWith("SUBSYSTEM==\"hidraw\", "));
  EXPECT_THAT(lines[1], StartsWith("SUBSYSTEM==\"usb\", "));
  for (const std::string& line : lines) {
    EXPECT_THAT(line, HasSubstr(", TAG+=\"uaccess\", GROUP=\"plugdev\", MODE=\"0660\""));
    EXPECT_THAT(line, HasSubstr("1209"));  // no rule for every device there is
    EXPECT_THAT(line, HasSubstr("0001"));
  }
}

}  // namespace
}  // namespace hapticwall
