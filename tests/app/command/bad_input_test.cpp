// Wrong inputs that no line of wrong_inputs.txt can hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class BadInput : public ProgramTest {
 protected:
  void expect_refused(std::vector<std::string> arguments, int status, const std::string& line) {
    const std::vector<std::string> before = files();
    const Answer answer = hapticwall(std::move(arguments));
    EXPECT_EQ(answer.status, status) << answer.err;
    EXPECT_EQ(answer.err, "error: " + line + "\n");
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_EQ(files(), before);
  }
};

TEST_F(BadInput, NoOutputThatWasAskedForComesToBe) {
  put("bad.toml", "name = 1\n");
  expect_refused({"run", "bad.toml", "--csv", "a.csv", "--json", "a.json", "--plot", "a.png"}, 2,
                 "bad.toml:1: name: 1 where a string belongs");
  expect_refused({"compare", "press", "--sort", "contact", "--csv", "a.csv", "--plot", "a.png"}, 2,
                 "--sort 'contact': the summary has no key 'contact'; did you mean 'contacts'?");
}

TEST_F(BadInput, TenMegabytesOfGarbage) {
  constexpr std::size_t kGarbageBytes = 10'000'000;
  std::string garbage;
  garbage.resize(kGarbageBytes);
  std::mt19937 random(1);
  for (char& c : garbage) c = static_cast<char>(random() & 0xffU);
  put("garbage.toml", garbage);
  expect_refused({"run", "garbage.toml", "--csv", "a.csv"}, 2,
                 "garbage.toml: not a scene: larger than 1048576 bytes");
  put("garbage.toml", garbage.substr(0, 1'000'000));
  const Answer answer = hapticwall({"run", "garbage.toml", "--csv", "a.csv"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, StartsWith("error: garbage.toml:1: not valid TOML: "));
  EXPECT_EQ(answer.error_lines(), 1);
}

TEST_F(BadInput, MessagesAreShortAndClean) {
  const std::string word = "x\n\x1b[31m\xff" + std::string(100'000, 'y');
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{word},
                                                    {"run", word},
                                                    {"run", "press", "--set", word},
                                                    {"run", "press", "--set", word + "=1"},
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
