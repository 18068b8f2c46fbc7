// The tables [in] and [out] of device files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/file/scene/device_file.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHead =
    "source = \"s\"\n[usb]\nvendor_id = 1\nproduct_id = 2\n[x]\nencoder_m = 1e-5\n"
    "force_limit_n = 5\n";
const std::string kIn = "[in]\nbytes = 14\nx = { offset = 2, type = \"i16\", m_per_unit = 1e-5 }\n";
const std::string kOut = "[out]\nbytes = 8\nx = { offset = 0, type = \"f32\", n_per_unit = -2 }\n";

TEST(DialectFile, ReadsEveryKey) {
  const std::string text =
      std::string(kHead) + "[y]\nencoder_m = 1e-5\nforce_limit_n = 3\n" + kIn +
      "y = { offset = 10, type = \"u32\", m_per_unit = -2e-5 }\nreport_id = 3\nusage_page = "
      "0xFFAB\n"
      "reports_on_change = true\n" +
      kOut +
      "y = { offset = 7, type = \"i8\", n_per_unit = 0.1, clamp = 50 }\nreport_id = 4\n"
      "keep_alive_ms = 20\n";
  const Result<DeviceDescription> device = parse_device(text, "d.toml");
  ASSERT_TRUE(device) << device.error().message;
  Dialect expected;
  expected.usage_page = 0xFFAB;
  expected.in = {
      3, 14, {ReportField{2, FieldType::kI16, 1e-5}, ReportField{10, FieldType::kU32, -2e-5}}};
  expected.out = {
      4, 8, {ReportField{0, FieldType::kF32, -2.0}, ReportField{7, FieldType::kI8, 0.1, 50.0}}};
  expected.reports_on_change = true;
  expected.keep_alive_ms = 20;
  EXPECT_EQ(device->dialect, expected);
}

TEST(DialectFile, WhatIsNotGivenIsTheSaferOne) {
  const Result<DeviceDescription> device = parse_device(kHead + kIn + kOut, "d.toml");
  ASSERT_TRUE(device) << device.error().message;
  ASSERT_TRUE(device->dialect);
  EXPECT_FALSE(device->dialect->reports_on_change);
  EXPECT_EQ(device->dialect->keep_alive_ms, 10);
  EXPECT_EQ(device->dialect->in.id, 0);
  EXPECT_EQ(device->dialect->usage_page, 0);
  EXPECT_FALSE(parse_device(kHead, "d.toml")->dialect);
}

TEST(DialectFile, EveryMistakeIsOneLine) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kHead + kIn + kOut;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const Result<DeviceDescription> device = parse_device(text, "d.toml");
    return device ? "(no error)" : device.error().message;
  };
  EXPECT_THAT(with(kOut, ""), HasSubstr("out is missing; it takes a table [out] beside [in]"));
  EXPECT_THAT(with(kIn, ""), HasSubstr("in is missing"));
  EXPECT_EQ(with("bytes = 14", "bytes = 65"),
            "d.toml:9: in.bytes: 65 is out of range; it takes 1 to 64");
  EXPECT_THAT(with("bytes = 14", "bytes = 14\nreport_id = 256"),
              HasSubstr("in.report_id: 256 is out of range; it takes 0 to 255"));
  EXPECT_EQ(with("offset = 2", "offset = 13"),
            "d.toml:10: in.x.offset: 13 is out of range; it takes 0 to 12");
  EXPECT_EQ(with("bytes = 14", "bytes = 1"),
            "d.toml:10: in.x.type: it has 2 bytes, the report has 1");
  EXPECT_THAT(with("\"i16\"", "\"i24\""), HasSubstr("in.x.type: 'i24' is no type here; it takes"));
  EXPECT_THAT(with("\"f32\"", "\"u16\""), HasSubstr("out.x.type: 'u16' is no type here"));
  EXPECT_THAT(with("m_per_unit = 1e-5", "m_per_unit = 0"), HasSubstr("in.x.m_per_unit: 0 is out"));
  EXPECT_THAT(with("n_per_unit = -2", "n_per_unit = nan"), HasSubstr("out.x.n_per_unit"));
  EXPECT_THAT(with("n_per_unit = -2", "n_per_unit = -2, clamp = 0"), HasSubstr("out.x.clamp: 0"));
  EXPECT_THAT(with("m_per_unit = 1e-5", "m_per_unit = 1e-5, clamp = 1"), HasSubstr("in.x.clamp"));
  EXPECT_THAT(with("bytes = 8", "bytes = 8\nkeep_alive_ms = 21"),
              HasSubstr("out.keep_alive_ms: 21 is out of range; it takes 1 to 20"));
  EXPECT_THAT(with("bytes = 8", "bytes = 8\ny = { offset = 4, type = \"i8\", n_per_unit = 1 }"),
              HasSubstr("out.y"));
  EXPECT_THAT(with("[in]", "[y]\nencoder_m = 1e-5\nforce_limit_n = 3\n[in]"),
              HasSubstr("in.y is missing; it takes { offset, type, m_per_unit }"));
}

TEST(DialectFile, TheExampleOfTheDocumentIsReadAndItsFieldsAreThoseOfTheText) {
  std::string example;
  bool inside = false;
  for (const std::string& line :
       hapticwall::test::lines_of(hapticwall::test::data_folder() + "/../docs/dialects.md")) {
    if (inside && line == "```") break;
    if (inside) example += line + "\n";
    inside = inside || line == "```toml device-file";
  }
  const Result<DeviceDescription> device = parse_device(example, "dialects.md");
  ASSERT_TRUE(device) << device.error().message;
  ASSERT_TRUE(device->dialect);
  EXPECT_EQ(device->dialect->out.axes[0], (ReportField{4, FieldType::kI16, -0.002, 2000.0}));
}

// Mechanics of a board, from the dimensions in the comment of its file.
struct Mechanics {
  const char* name;
  double body_m;
  double arm_m;
  double nm_per_ampere;
  double sign;  // of the encoder
};
class ShippedDialect : public ::testing::TestWithParam<Mechanics> {};

TEST_P(ShippedDialect, FollowsFromItsMechanics) {
  const Mechanics& mechanics = GetParam();
  const Result<DeviceDescription> device = load_device(mechanics.name);
  ASSERT_TRUE(device && device->dialect);
  constexpr double kTwoPi = 6.283185307179586;
  const double gear = mechanics.body_m / 0.010;
  const double count_m = kTwoPi / 2000.0 / gear * mechanics.arm_m;
  const ReportField in = *device->dialect->in.axes[0];
  const ReportField out = *device->dialect->out.axes[0];
  EXPECT_NEAR(in.per_unit, mechanics.sign * count_m, 1e-3 * count_m);
  EXPECT_EQ(device->x.encoder_m, std::abs(in.per_unit));
  EXPECT_NEAR(out.per_unit, 1e-3 * mechanics.nm_per_ampere * gear / mechanics.arm_m, 1e-6);
  EXPECT_LT(device->x.force_limit_n, out.clamp * out.per_unit);
}
INSTANTIATE_TEST_SUITE_P(Boards, ShippedDialect,
                         ::testing::Values(Mechanics{"polhem-v1", 0.180, 0.14, 0.0538, 1.0},
                                           Mechanics{"woodenhaptics", 0.160, 0.22, 0.0259, -1.0}));

}  // namespace
}  // namespace hapticwall::file
