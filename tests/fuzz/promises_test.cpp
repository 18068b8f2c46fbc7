// The promises themselves: what breaks one is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/fuzz/report_promises.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

using device::hid::Refusal;
using device::hid::StateReport;

constexpr Layout kLayout{0x01, true, {29, 0xFC}, 44};

bool any_bytes(Bytes) { return true; }
bool any_values(const StateReport&) { return true; }

ReportPromises<StateReport> usual() {
  return {kLayout, device::hid::decode_state, device::hid::encode_state, any_bytes, any_values};
}

std::vector<std::uint8_t> input() {
  const auto report = device::hid::encode_state({});
  std::vector<std::uint8_t> bytes(1 + report.size());  // the first one: nothing is to be repaired
  std::copy(report.begin(), report.end(), bytes.begin() + 1);
  return bytes;
}

TEST(ReportPromises, AWorkingCodecKeepsThem) {
  EXPECT_EQ(check_report(input(), usual()), Outcome::kTaken);
}

TEST(ReportPromises, ACodecThatTakesAnythingBreaksOne) {
  ReportPromises<StateReport> promises = usual();
  promises.decode = [](Bytes) { return device::hid::Decoded<StateReport>(StateReport{}); };
  EXPECT_THROW(check_report({}, promises), BrokenPromise);
}

TEST(ReportPromises, ACodecThatRefusesWhatIsRightBreaksOne) {
  ReportPromises<StateReport> promises = usual();
  promises.decode = [](Bytes) { return device::hid::Decoded<StateReport>(Refusal::kValue); };
  EXPECT_THROW(check_report(input(), promises), BrokenPromise);
}

TEST(ReportPromises, ACodecThatNamesAnotherReasonBreaksOne) {
  ReportPromises<StateReport> promises = usual();
  promises.decode = [](Bytes) { return device::hid::Decoded<StateReport>(Refusal::kValue); };
  EXPECT_THROW(check_report({}, promises), BrokenPromise);
}

TEST(ReportPromises, ACodecThatEncodesOtherBytesBreaksOne) {
  ReportPromises<StateReport> promises = usual();
  promises.encode = [](const StateReport& state) {
    StateReport other = state;
    other.buttons ^= 1U;
    return device::hid::encode_state(other);
  };
  EXPECT_THROW(check_report(input(), promises), BrokenPromise);
}

TEST(ReportPromises, ValuesOutOfTheirRangesBreakOne) {
  ReportPromises<StateReport> promises = usual();
  promises.values_make_sense = [](const StateReport&) { return false; };
  EXPECT_THROW(check_report(input(), promises), BrokenPromise);
  promises = usual();
  promises.bytes_make_sense = [](Bytes) { return false; };
  EXPECT_THROW(check_report(input(), promises), BrokenPromise);
}

TEST(TextPromises, AcceptsCleanText) {
  for (const char* text : {"", "plain", "\u00b5m \u2013 \u2126", "\xf0\x9f\x99\x82"}) {
    EXPECT_TRUE(is_clean(text)) << text;
  }
}

TEST(TextPromises, FindsTextThatIsNotClean) {
  for (const char* text : {"a\nb", "\x1b[2J", "\x7f", "\xc2\x9b", "\xc3", "\x80", "\xc0\x80",
                           "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff"}) {
    EXPECT_FALSE(is_clean(text)) << ::testing::PrintToString(std::string(text));
  }
}

TEST(TextPromises, AMessageIsOneLineThatNamesItsPlaceAndIsShort) {
  const auto broken = [](const std::string& message, ErrorKind kind = ErrorKind::kUsage) {
    try {
      require_one_clean_line({kind, message}, "a.toml");
    } catch (const BrokenPromise&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(broken("a.toml:3: x is missing"));
  EXPECT_TRUE(broken("a.toml"));
  EXPECT_TRUE(broken("x is missing"));
  EXPECT_TRUE(broken("a.toml: x\nis missing"));
  EXPECT_TRUE(broken("a.toml: " + std::string(5000, 'x')));
  EXPECT_TRUE(broken("a.toml: x is missing", ErrorKind::kFile));
}

}  // namespace
}  // namespace hapticwall::fuzz
