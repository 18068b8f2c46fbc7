// Device files: parsing, and one-line messages for errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/file/scene/device_file.h"
#include "core/scene_keys.h"

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;

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
min_m = -0.05
max_m = 0.06
max_speed_m_per_s = 3
max_force_rate_n_per_s = 2500
[y]
encoder_m = 2e-5
force_limit_n = 32.767
)";

TEST(DeviceFile, ReadsEveryKey) {
  const Result<DeviceDescription> device = parse_device(kWholeDevice, "d.toml");
  ASSERT_TRUE(device) << device.error().message;
  const DeviceDescription expected{"Stick",
                                   "a ruler and a spring scale",
                                   500.0,
                                   0x1209,
                                   0xffff,
                                   "A-1",
                                   {1e-5, 5.0, -0.05, 0.06, 2500.0, 3.0},
                                   AxisDescription{2e-5, 32.767}};
  EXPECT_EQ(*device, expected);
}

TEST(DeviceFile, OptionalKeysMayBeAbsent) {
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

constexpr const char* kWheel =
    "source = \"s\"\n[usb]\nvendor_id = 1\nproduct_id = 2\n[ff]\ntorque_nm = 2.1\n";

TEST(DeviceFile, AWheelHasSafeDefaults) {
  const Result<DeviceDescription> device = parse_device(kWheel, "w.toml");
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ(device->ff, (FfDescription{0.13, 900.0, 2.1, 1.0, 0.0, 0.0, ""}));
  EXPECT_EQ(device->x.force_limit_n, 5.0);
}

TEST(DeviceFile, AWheelHasKeysOfItsOwn) {
  const Result<DeviceDescription> device = parse_device(
      std::string(kWheel) +
          "radius_m = 0.1\ntravel_deg = 40\nsign = -1\nrate_hz = 400\ndelay_s = 0.003\n"
          "delay_date = \"2026-01-31\"\n"
          "[x]\nforce_limit_n = 2\nmax_speed_m_per_s = 3\nmax_force_rate_n_per_s = 100\n",
      "w.toml");
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ(device->ff, (FfDescription{0.1, 40.0, 2.1, -1.0, 400.0, 0.003, "2026-01-31"}));
  EXPECT_EQ(device->x, (AxisDescription{0.0, 2.0, -0.3, 0.3, 100.0, 3.0}));
  for (const char* wrong : {"sign = 0.5", "sign = 0", "rate_hz = 5", "torque = 1", "delay_s = -1",
                            "delay_s = 0.003", "[x]\nencoder_m = 1e-5", "[y]\nforce_limit_n = 1"}) {
    EXPECT_FALSE(parse_device(std::string(kWheel) + wrong + "\n", "w.toml")) << wrong;
  }
}

TEST(BuiltinDevice, EachCanBeReadAndSaysWhereItsNumbersComeFrom) {
  ASSERT_EQ(builtin_devices().size(), 12U);
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

TEST(BuiltinDevice, SomeHaveTheLimitsOfChai3d) {
  const auto limits = [](const char* name) { return load_device(name)->chai3d; };
  EXPECT_EQ(limits("phantom-premium-1.5"), (ChaiLimits{800.0, 5.0}));
  EXPECT_EQ(limits("touch"), (ChaiLimits{400.0, 4.0}));
  EXPECT_EQ(limits("touch-x"), (ChaiLimits{1000.0, 5.0}));
  EXPECT_EQ(limits("omega-3"), (ChaiLimits{5000.0, 30.0}));
  EXPECT_EQ(limits("falcon"), (ChaiLimits{3000.0, 20.0}));
  EXPECT_EQ(limits("hapkit"), std::nullopt);
  const auto falcon = load_device("falcon");
  EXPECT_EQ(*parse_device(device_to_toml(*falcon), "falcon.toml"), *falcon);
}

TEST(LoadDevice, SaysWhatItDoesNotFind) {
  const auto line = [](const std::string& name) {
    const Result<DeviceDescription> device = load_device(name);
    return device ? "(no error)" : device.error().message;
  };
  EXPECT_EQ(
      line("impulse-engine-200"),
      "'impulse-engine-200' is neither a file nor a built-in device; did you mean "
      "'impulse-engine-2000'?; built in: falcon, force-feedback-wheel, hapkit, home-made-paddle, "
      "impulse-engine-2000, impulse-engine-2000-fine, omega-3, phantom-premium-1.5, polhem-v1, "
      "touch, touch-x, woodenhaptics");
  EXPECT_THAT(line("./no-such.toml"), HasSubstr("./no-such.toml: cannot be read: "));
  EXPECT_EQ(line("/dev/null"), "/dev/null: not a device description: not a file");
  EXPECT_EQ(line("/dev/zero"), "/dev/zero: not a device description: not a file");
}

}  // namespace
}  // namespace hapticwall::file
