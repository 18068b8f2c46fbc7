// Wrong inputs that no line of wrong_inputs.txt can hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class BadInput : public ProgramTest {};

TEST_F(BadInput, TenMegabytesOfGarbage) {
  constexpr std::size_t kGarbageBytes = 10'000'000;
  std::string garbage;
  garbage.resize(kGarbageBytes);
  std::mt19937 random(1);
  for (char& c : garbage) c = static_cast<char>(random() & 0xffU);
  put("garbage.toml", garbage);
  const Answer too_large = hapticwall({"run", "garbage.toml", "--csv", "a.csv"});
  EXPECT_EQ(too_large.status, 2);
  EXPECT_EQ(too_large.err, "error: garbage.toml: not a scene: larger than 1048576 bytes\n");
  put("garbage.toml", garbage.substr(0, 1'000'000));
  const Answer answer = hapticwall({"run", "garbage.toml", "--csv", "a.csv"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, StartsWith("error: garbage.toml:1: not valid TOML: "));
  EXPECT_EQ(answer.error_lines(), 1);
  EXPECT_THAT(files(), ElementsAre("garbage.toml"));
}

TEST_F(BadInput, MessagesAreShortAndClean) {
  const std::string word = "x\n\x1b[31m\xff" + std::string(100'000, 'y');
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{word},
                                                    {"run", word},
                                                    {"run", "press", "--set", word},
                                                    {"run", "press", "--set", word + "=1"},
                                                    {"run", "press", "--set", "name=[" + word},
                                                    {"run", "press", "--algorithm", word},
                                                    {"run", "press", "--" + word},
                                                    {"run", "press", "--expect", word + "=1"},
                                                    {"run", "press", "--csv", word + "/a"},
                                                    {"run", "press", "--device", word}}) {
    const Answer answer = hapticwall(arguments);
    EXPECT_GE(answer.status, 2);
    EXPECT_LE(answer.status, 4);
    EXPECT_EQ(answer.error_lines(), 1) << answer.err;
    EXPECT_LT(answer.err.size(), 1200U);
    EXPECT_EQ(answer.err.find('\x1b'), std::string::npos);
  }
}

}  // namespace
}  // namespace hapticwall::command::test
