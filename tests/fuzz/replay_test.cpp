// Every target's first inputs, and what lies next to them, without a fuzzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "tests/fuzz/target.h"
#include "tests/paths.h"

namespace hapticwall::fuzz {

static std::ostream& operator<<(std::ostream& out, const Target& target) {
  return out << target.name;
}

namespace {

struct FirstInput {
  std::string name;  // file name; its beginning gives the outcome
  std::vector<std::uint8_t> bytes;
};

std::vector<FirstInput> first_inputs(std::string_view target) {
  const std::filesystem::path folder = test::data_folder() + "/fuzz/corpus";
  std::vector<FirstInput> inputs;
  for (const auto& entry : std::filesystem::directory_iterator(folder / target)) {
    std::ifstream file(entry.path(), std::ios::binary);
    EXPECT_TRUE(file) << entry.path();
    inputs.push_back({entry.path().filename().string(),
                      {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}});
  }
  std::sort(inputs.begin(), inputs.end(),
            [](const FirstInput& a, const FirstInput& b) { return a.name < b.name; });
  return inputs;
}

class FuzzTarget : public ::testing::TestWithParam<Target> {};

TEST_P(FuzzTarget, DoesWithItsFirstInputsWhatTheirNamesSay) {
  int taken = 0;
  int refused = 0;
  for (const FirstInput& input : first_inputs(GetParam().name)) {
    SCOPED_TRACE(input.name);
    const Outcome outcome = GetParam().fuzz_one(input.bytes);
    ++(outcome == Outcome::kTaken ? taken : refused);
    EXPECT_TRUE(input.name.starts_with(outcome == Outcome::kTaken ? "taken-" : "refused-"));
  }
  EXPECT_GT(taken, 0);
  EXPECT_GT(refused, 0);
}

TEST_P(FuzzTarget, KeepsItsPromisesAllAroundItsFirstInputs) {
  for (const FirstInput& input : first_inputs(GetParam().name)) {
    for (std::size_t i = 0; i < input.bytes.size(); ++i) {
      SCOPED_TRACE(input.name + ", byte " + std::to_string(i));
      std::vector<std::uint8_t> changed = input.bytes;
      changed[i] ^= static_cast<std::uint8_t>(1U << i % 8);
      EXPECT_NO_THROW(GetParam().fuzz_one(changed));
      EXPECT_NO_THROW(GetParam().fuzz_one(Bytes(input.bytes).first(i)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, FuzzTarget, ::testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace hapticwall::fuzz
