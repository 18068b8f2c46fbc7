// A scene that names a device file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <vector>

#include "app/file/scene/device_file.h"
#include "app/file/scene/scene_file.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPaddle = R"(name = "Paddle"
source = "a scale"
identified = "2026-01-02T03:04:05Z, 95 % intervals: m 0.06 to 0.07 kg"
[x]
encoder_m = 2e-5
force_limit_n = 4
mass_kg = 0.065
damping_n_s_per_m = 0.7
friction_n = 0.11
)";

class SceneDevice : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override { put("paddle.toml", kPaddle); }

  [[nodiscard]] Result<LoadedScene> scene(const std::string& text,
                                          const std::vector<std::string>& overrides = {}) {
    put("scene.toml", "duration_s = 1\n" + text);
    return load_scene(path("scene.toml"), overrides);
  }
  void expect_refused(const std::string& text, const std::string& message) {
    const auto loaded = scene(text);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, HasSubstr(message));
  }
};

TEST_F(SceneDevice, TheNameGivesTheNumbers) {
  for (const char* name : {"paddle", "paddle.toml"}) {
    const auto loaded = scene(std::string("device = \"") + name + "\"\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const DeviceSettings& device = loaded->scene.x().device;
    EXPECT_EQ(device.mass_kg, 0.065);
    EXPECT_EQ(device.damping_n_s_per_m, 0.7);
    EXPECT_EQ(device.friction_n, 0.11);
    EXPECT_EQ(device.encoder_m, 2e-5);
    EXPECT_EQ(device.force_limit_n, 4.0);
    EXPECT_EQ(loaded->scene.description,
              "device Paddle: 2026-01-02T03:04:05Z, 95 % intervals: m 0.06 to 0.07 kg");
  }
}

// Opening a pipe would wait for its writer.
TEST_F(SceneDevice, APipeIsNotOpened) {
  ASSERT_EQ(mkfifo(path("pipe.toml").c_str(), 0600), 0);
  expect_refused("device = \"pipe\"\n", "pipe.toml: not a device description: not a file");
}

// The device is that of --set device=NAME on the command line, except for the description.
TEST_F(SceneDevice, AScenesDeviceBecomesThatOfAFile) {
  for (const std::string& name : {std::string("phantom-premium-1.5"), path("paddle.toml")}) {
    const std::vector<std::string> overrides{"device=" + name};
    const Scene before = load_scene("corner")->scene;
    Scene expected = load_scene("corner", overrides)->scene;
    expected.description = before.description;
    const auto changed = with_device(before, name);
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_EQ(*changed, expected);
    EXPECT_NE(*changed, before);
  }
  for (const char* nothing : {"nothere", "", "a\nb"}) {
    const auto refused = with_device(load_scene("press")->scene, nothing);
    ASSERT_FALSE(refused) << nothing;
    EXPECT_THAT(refused.error().message, ::testing::Not(HasSubstr("\n")));
  }
  EXPECT_THAT(with_device(load_scene("press")->scene, "nothere").error().message,
              HasSubstr("nothere.toml: cannot be read"));
}

// Numbers that a file does not give stay the scene's own.
TEST_F(SceneDevice, APresetReplacesTheNumbersThatItHas) {
  const auto device = [](const std::string& name) {
    const std::vector<std::string> overrides{"device=" + name};
    const auto loaded = load_scene("press", overrides);
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded->scene.x().device;
  };
  const DeviceSettings before = load_scene("press", {})->scene.x().device;
  for (const char* preset : {"falcon", "hapkit", "omega-3", "touch", "touch-x"}) {
    SCOPED_TRACE(preset);
    DeviceSettings expected = before;
    const AxisDescription& x = load_device(preset)->x;
    if (x.encoder_m > 0.0) expected.encoder_m = x.encoder_m;
    expected.force_limit_n = x.force_limit_n;
    if (const auto chai3d = load_device(preset)->chai3d) {
      expected.chai3d_stiffness_n_per_m = chai3d->max_stiffness_n_per_m;
      expected.chai3d_damping_n_s_per_m = chai3d->max_damping_n_s_per_m;
    }
    EXPECT_EQ(device(preset), expected);
    EXPECT_NE(device(preset), before);
  }
  EXPECT_EQ(device("omega-3").encoder_m, before.encoder_m);
  const DeviceSettings phantom = device("phantom-premium-1.5");
  EXPECT_EQ(phantom.mass_kg, 0.0953);
  EXPECT_EQ(phantom.damping_n_s_per_m, 0.0114);
  EXPECT_EQ(phantom.friction_n, 0.0477);
  EXPECT_EQ(phantom.encoder_m, 24.17e-6);
  EXPECT_EQ(phantom.force_limit_n, 8.19);
}

// The numbers of CHAI3D are also in the scene's text, as a recording keeps it, and gone with the
// next device.
TEST_F(SceneDevice, WhatChai3dAllowsIsOfOneDevice) {
  const auto omega = load_scene("press", std::vector<std::string>{"device=omega-3"});
  ASSERT_TRUE(omega) << omega.error().message;
  EXPECT_EQ(omega->scene.x().device.chai3d_stiffness_n_per_m, 5000.0);
  EXPECT_EQ(omega->scene.x().device.chai3d_damping_n_s_per_m, 30.0);
  const std::string text = scene_to_toml(omega->scene);
  EXPECT_EQ(parse_scene(text, "again.toml")->scene, omega->scene);
  const std::vector<std::string> next{"device=hapkit"};
  const auto hapkit = parse_scene(text, "again.toml", next);
  ASSERT_TRUE(hapkit) << hapkit.error().message;
  EXPECT_EQ(hapkit->scene.x().device.chai3d_stiffness_n_per_m, std::nullopt);
  EXPECT_EQ(hapkit->scene.x().device.chai3d_damping_n_s_per_m, std::nullopt);
}

TEST_F(SceneDevice, ATableKeepsItsOwnNumbers) {
  const auto loaded = scene("[device]\nfile = \"paddle\"\nmass_kg = 0.5\nstart_m = 0.01\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.x().device.mass_kg, 0.5);
  EXPECT_EQ(loaded->scene.x().device.damping_n_s_per_m, 0.7);
  EXPECT_EQ(loaded->scene.x().device.start_m, 0.01);
}

TEST_F(SceneDevice, SetReplacesTheNumbersAndKeepsTheRest) {
  const std::string own =
      "[device]\nmass_kg = 0.5\ndamping_n_s_per_m = 3\nstart_m = 0.02\ndelay_ticks = 2\n";
  const auto loaded = scene(own, {"device=" + path("paddle.toml"), "device.friction_n=0.3"});
  ASSERT_TRUE(loaded) << loaded.error().message;
  const DeviceSettings& device = loaded->scene.x().device;
  EXPECT_EQ(device.mass_kg, 0.065);
  EXPECT_EQ(device.start_m, 0.02);
  EXPECT_EQ(device.delay_ticks, 2);
  EXPECT_EQ(device.friction_n, 0.3);
}

TEST_F(SceneDevice, TheNoteSurvivesTheSidecar) {
  const auto loaded = scene("device = \"paddle\"\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const auto again = parse_scene(scene_to_toml(loaded->scene), "again.toml");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->scene, loaded->scene);
}

TEST_F(SceneDevice, ADeviceWithoutMassNeedsOneFromTheScene) {
  const std::string builtin = "device = \"home-made-paddle\"\n";
  expect_refused(builtin, "device.mass_kg is missing");
  const auto loaded =
      scene("[device]\nfile = \"home-made-paddle\"\nmass_kg = 0.1\ndamping_n_s_per_m = 1\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.x().device.encoder_m, 1.466e-5);
  EXPECT_THAT(loaded->scene.description, HasSubstr("calculated from the parts"));
}

TEST_F(SceneDevice, MistakesNameTheirPlace) {
  expect_refused("device = \"nothing\"\n", "scene.toml:2: device: ");
  expect_refused("[device]\nfile = 3\n", "scene.toml:3: device.file: ");
  put("bad.toml", std::string(kPaddle) + "spin = 1\n");
  expect_refused("device = \"bad\"\n", "bad.toml:10: x.spin: unknown key");
  expect_refused("device = \"/dev/zero\"\n", "device: ");
}

// All keys of a dialect, and a wheel with every number.
constexpr const char* kKnob = R"(source = "s"
identified = "today"
[usb]
vendor_id = 1
product_id = 2
serial = "a \"b\""
[x]
encoder_m = 1e-5
force_limit_n = 5
mass_kg = 0.1
max_force_rate_n_per_s = 100
[y]
encoder_m = 2e-5
force_limit_n = 3
friction_n = 0
[in]
bytes = 14
report_id = 3
usage_page = 0xFFAB
reports_on_change = true
x = { offset = 2, type = "i16", m_per_unit = 1e-5 }
y = { offset = 10, type = "u32", m_per_unit = -2e-5 }
[out]
bytes = 8
report_id = 4
keep_alive_ms = 20
x = { offset = 0, type = "f32", n_per_unit = -2 }
y = { offset = 7, type = "i8", n_per_unit = 0.1, clamp = 50 }
)";
constexpr const char* kWheel = R"(source = "s"
[usb]
vendor_id = 1
product_id = 2
[ff]
radius_m = 0.15
travel_deg = 540
torque_nm = 2
sign = -1
rate_hz = 400
delay_s = 0.004
delay_date = "2026-01-31"
[x]
force_limit_n = 3
damping_n_s_per_m = 0.3
)";

TEST_F(SceneDevice, EveryFileOfADeviceReadsBackTheSame) {
  put("knob.toml", kKnob);
  put("wheel.toml", kWheel);
  std::vector<std::string> files{path("paddle.toml"), path("knob.toml"), path("wheel.toml")};
  for (const BuiltinDevice& device : builtin_devices()) files.push_back(device.name);
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const auto device = load_device(file);
    ASSERT_TRUE(device) << device.error().message;
    const auto again = parse_device(device_to_toml(*device), "again.toml");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, *device);
  }
}

}  // namespace
}  // namespace hapticwall::file
