// Device files: parsing, and one-line messages for errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/file/scene/device_file.h"
#include "core/scene_keys.h"

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kWholeDevice = R"(name = "Stick"
source = "a ruler and a spring scale"
rate_hz = 500
[usb]
vendor_id = 0x1209
product_id = 0xffff
serial = "A-1"
[x]
encoder_m = 1e-5
force_limit_n = 5
[y]
encoder_m = 2e-5
force_limit_n = 32.767
)";

std::string device_message(const std::string& text) {
  const Result<DeviceDescription> device = parse_device(text, "d.toml");
  if (device) return "(no error)";
  EXPECT_EQ(device.error().kind, ErrorKind::kUsage);
  EXPECT_EQ(device.error().message.find('\n'), std::string::npos) << device.error().message;
  return device.error().message;
}

std::string device_with(const std::string& what, const std::string& by) {
  std::string text = kWholeDevice;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(DeviceFile, ReadsEveryKey) {
  const Result<DeviceDescription> device = parse_device(kWholeDevice, "d.toml");
  ASSERT_TRUE(device) << device.error().message;
  const DeviceDescription expected{
      "Stick",     "a ruler and a spring scale", 500.0, 0x1209, 0xffff, "A-1",
      {1e-5, 5.0}, AxisDescription{2e-5, 32.767}};
  EXPECT_EQ(*device, expected);
}

TEST(DeviceFile, WhatMayBeAbsentIs) {
  const Result<DeviceDescription> device = parse_device(
      "source = \"s\"\n[usb]\nvendor_id = 1\nproduct_id = 2\n"
      "[x]\nencoder_m = 1e-5\nforce_limit_n = 5\n",
      "dir/bare.toml");
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ(device->name, "bare");
  EXPECT_EQ(device->rate_hz, 1000.0);
  EXPECT_EQ(device->serial, "");
  EXPECT_FALSE(device->y);
}

TEST(DeviceFile, WhatIsMissingIsNamed) {
  EXPECT_EQ(device_message(device_with("vendor_id = 0x1209\n", "")),
            "d.toml:4: usb.vendor_id is missing; it takes a number from 0x0001 to 0xffff");
  EXPECT_EQ(device_message(device_with("encoder_m = 1e-5\n", "")),
            "d.toml:8: x.encoder_m is missing; it takes a number in m");
  EXPECT_EQ(device_message(device_with("force_limit_n = 32.767\n", "")),
            "d.toml:11: y.force_limit_n is missing; it takes a number in N");
  EXPECT_THAT(device_message(device_with("source = \"a ruler and a spring scale\"\n", "")),
              HasSubstr("source is missing"));
  EXPECT_THAT(device_message("source = \"s\"\n"), HasSubstr("usb is missing"));
  EXPECT_THAT(device_message("source = \"s\"\n[usb]\nvendor_id = 1\nproduct_id = 1\n"),
              HasSubstr("x is missing"));
}

TEST(DeviceFile, WhatIsOutOfRangeIsNamedWithItsRange) {
  EXPECT_EQ(device_message(device_with("encoder_m = 2e-5", "encoder_m = 0")),
            "d.toml:12: y.encoder_m: 0 is out of range; it takes 1e-9 to 0.01 m");
  EXPECT_EQ(device_message(device_with("encoder_m = 1e-5", "encoder_m = 0.011")),
            "d.toml:9: x.encoder_m: 0.011 is out of range; it takes 1e-9 to 0.01 m");
  EXPECT_EQ(
      device_message(device_with("force_limit_n = 5", "force_limit_n = 0")),
      "d.toml:10: x.force_limit_n: 0 is out of range; it takes more than 0, at most 32.767 N");
  EXPECT_THAT(device_message(device_with("force_limit_n = 5", "force_limit_n = 33")),
              HasSubstr("33 is out of range"));
  EXPECT_EQ(device_message(device_with("rate_hz = 500", "rate_hz = 9")),
            "d.toml:3: rate_hz: 9 is out of range; it takes 10 to 10000 Hz");
  EXPECT_EQ(device_message(device_with("vendor_id = 0x1209", "vendor_id = 0x10000")),
            "d.toml:5: usb.vendor_id: 65536 is out of range; it takes 0x0001 to 0xffff");
  EXPECT_THAT(device_message(device_with("product_id = 0xffff", "product_id = 0")),
              HasSubstr("d.toml:6: usb.product_id: 0 is out of range"));
}

TEST(DeviceFile, WhatIsNoSuchThingIsNamed) {
  EXPECT_EQ(device_message(device_with("encoder_m = 1e-5", "encoder_m = \"fine\"")),
            "d.toml:9: x.encoder_m: the string 'fine' where a number in m belongs");
  EXPECT_THAT(device_message(device_with("encoder_m = 1e-5", "encoder_m = nan")),
              HasSubstr("not a finite number"));
  EXPECT_THAT(device_message(device_with("vendor_id = 0x1209", "vendor_id = -1")),
              HasSubstr("a whole number from 0 on"));
  EXPECT_EQ(device_message(device_with("serial", "seriel")),
            "d.toml:7: usb.seriel: unknown key; did you mean 'serial'?");
  EXPECT_THAT(device_message(device_with("[y]", "[z]")), StartsWith("d.toml:11: z: unknown key"));
  EXPECT_EQ(device_message(device_with("[x]", "[[x]]")),
            "d.toml:8: x: an array where a table [x] belongs");
  EXPECT_THAT(device_message(device_with("A-1", "A\\n1")),
              HasSubstr("usb.serial: has a control character"));
  EXPECT_THAT(device_message(device_with("A-1", std::string(200, 'A'))),
              HasSubstr("longer than 126 bytes"));
  EXPECT_THAT(device_message("source = "), StartsWith("d.toml:1: not valid TOML"));
  std::string deep = "a";
  for (int i = 0; i < 5000; ++i) deep += ".a";
  EXPECT_THAT(device_message(deep + " = 1\n"),
              StartsWith("d.toml: not a device description: keys of"));
}

TEST(BuiltinDevice, EachCanBeReadAndSaysWhereItsNumbersComeFrom) {
  ASSERT_EQ(builtin_devices().size(), 3U);
  for (const BuiltinDevice& builtin : builtin_devices()) {
    const Result<DeviceDescription> device = load_device(builtin.name);
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_GT(device->source.size(), 20U) << builtin.name;
    EXPECT_EQ(builtin.toml_text.substr(0, 1), "#") << builtin.name;
  }
}

TEST(BuiltinDevice, TheImpulseEngineComesInBothResolutionsOfThePaper) {
  const Result<DeviceDescription> coarse = load_device("impulse-engine-2000");
  const Result<DeviceDescription> fine = load_device("impulse-engine-2000-fine");
  ASSERT_TRUE(coarse && fine);
  EXPECT_EQ(coarse->x.encoder_m, 0.254e-3);
  EXPECT_NEAR(fine->x.encoder_m, 0.0008 * 25.4e-3, 1e-12);
  for (const Result<DeviceDescription>& device : {coarse, fine}) {
    EXPECT_EQ(device->x.force_limit_n, 8.9);
    ASSERT_TRUE(device->y);
    EXPECT_EQ(*device->y, device->x);
  }
}

TEST(BuiltinDevice, ThePaddlesNumbersFollowFromItsParts) {
  constexpr double kPi = 3.14159265358979;
  const Result<DeviceDescription> paddle = load_device("home-made-paddle");
  ASSERT_TRUE(paddle) << paddle.error().message;
  EXPECT_NEAR(paddle->x.encoder_m, kPi * 10e-3 * (70.0 / 75.0) / 2000.0, 1e-9);
  EXPECT_LE(paddle->x.force_limit_n, 25e-3 / 5e-3 * (75.0 / 70.0));
  EXPECT_FALSE(paddle->y);
}

TEST(LoadDevice, SaysWhatItDoesNotFind) {
  const auto line = [](const std::string& name) {
    const Result<DeviceDescription> device = load_device(name);
    return device ? "(no error)" : device.error().message;
  };
  EXPECT_EQ(line("impulse-engine-200"),
            "'impulse-engine-200' is neither a file nor a built-in device; did you mean "
            "'impulse-engine-2000'?; built in: home-made-paddle, impulse-engine-2000, "
            "impulse-engine-2000-fine");
  EXPECT_THAT(line("./no-such.toml"), HasSubstr("./no-such.toml: cannot be read: "));
  EXPECT_EQ(line("/dev/null"), "/dev/null: not a device description: empty");
  EXPECT_EQ(line("/dev/zero"), "/dev/zero: not a device description: larger than 65536 bytes");
}

}  // namespace
}  // namespace hapticwall::file
