// The text form of faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/emulator/program/emulator_options.h"

namespace hapticwall::emulator {
namespace {

using device::hid::Fault;
using device::hid::FaultKind;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Fault fault_of(const std::string& text) {
  const Result<Fault> fault = parse_fault(text);
  EXPECT_TRUE(fault.ok()) << text;
  return fault ? *fault : Fault{};
}

std::string refusal_of(const std::string& text) {
  const Result<Fault> fault = parse_fault(text);
  if (fault) return "";
  EXPECT_EQ(fault.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(fault.error().message, StartsWith("--fault '" + text + "': "));
  return fault.error().message;
}

TEST(FaultText, KindBeginAndDuration) {
  const Fault fault = fault_of("unplugged@3+1");
  EXPECT_EQ(fault.kind, FaultKind::kUnplugged);
  EXPECT_EQ(fault.begin_us, 3'000'000U);
  EXPECT_EQ(fault.duration_us, 1'000'000U);
  EXPECT_EQ(fault.every, 1U);
}

TEST(FaultText, PartsOfASecondAndEverySoManyTicks) {
  const Fault fault = fault_of("bad-crc@0.0015+2.5/10");
  EXPECT_EQ(fault.kind, FaultKind::kBadCrc);
  EXPECT_EQ(fault.begin_us, 1500U);
  EXPECT_EQ(fault.duration_us, 2'500'000U);
  EXPECT_EQ(fault.every, 10U);
}

TEST(FaultText, EveryKindHasItsWord) {
  std::istringstream words(fault_names());
  int kind = 0;
  for (std::string word; std::getline(words >> std::ws, word, ',');) {
    EXPECT_EQ(static_cast<int>(fault_of(word + "@1+1").kind), kind) << word;
    ++kind;
  }
  EXPECT_EQ(kind, static_cast<int>(device::hid::kFaultKinds));
}

TEST(FaultText, AnUnknownFaultGetsTheListOfFaults) {
  for (const char* text : {"", "unplugged", "unplugged@3", "unplugged+1", "unplugged+1@3"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("KIND@BEGIN+DURATION")) << text;
  }
  EXPECT_THAT(refusal_of("unplugd@3+1"), HasSubstr("did you mean 'unplugged'?"));
  EXPECT_THAT(refusal_of("@3+1"), HasSubstr("known: empty, short"));
  for (const char* text : {"silent@+1", "silent@1+", "silent@-1+1", "silent@1+nan", "silent@1s+1",
                           "silent@1+inf", "silent@0+86401"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("seconds, 0 to 86400")) << text;
  }
  for (const char* text : {"short@1+1/", "short@1+1/0", "short@1+1/-2", "short@1+1/2.5"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("a number of ticks, 1 to 1000000")) << text;
  }
}

}  // namespace
}  // namespace hapticwall::emulator
