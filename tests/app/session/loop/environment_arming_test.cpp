// Environments on an emulated device that tells the truth, in virtual time.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "core/environment/environment.h"
#include "core/scene_keys.h"
#include "tests/app/session/loop/lie_rig.h"

namespace hapticwall::session::test {
namespace {

Scene scene_in(std::size_t environment) {
  Scene scene;
  scene.x().device.force_limit_n = device::hid::testing::kLimitN;
  scene.environment.index = environment;
  scene.algorithm.index = find_algorithm("none").value();
  return scene;
}

void set_number(Scene& scene, std::string_view key, double value) {
  find_scene_number(scene, key).value().set(scene, value);
}

LieRig rig_of(const Scene& scene, bool moves) {
  return {device::hid::FaultScript({}), held_device(moves), {}, scene, nullptr};
}

// The hand moves from 30 to 70 mm: into tissue and over detents, a hill and with a mass.
TEST(EnvironmentArming, AnHonestDeviceStaysArmedInEach) {
  for (std::size_t i = 1; i < environments().size(); ++i) {
    if (environments()[i].plugin != nullptr) continue;
    SCOPED_TRACE(std::string(environments()[i].description.name));
    Scene scene = scene_in(i);
    set_number(scene, "environment.centre_x_m", 0.06);  // the handle begins at its foot
    LieRig rig = rig_of(scene, true);
    rig.until_ms(50);
    rig.arm();
    rig.until_ms(2000);
    EXPECT_EQ(rig.arming().state, ArmingState::kOn) << arming_note_text(rig.arming().note);
    EXPECT_GT(rig.peak_n, 0.1);
  }
}

// 2 N a quarter of the spacing off a detent; the handle is at 30 mm.
TEST(EnvironmentArming, IsRefusedWhereTheForceIsNotSmall) {
  for (const double off_m : {0.0, 0.0025}) {
    Scene scene = scene_in(find_environment("detents").value());
    set_number(scene, "environment.position_m", 0.03 + off_m);
    LieRig rig = rig_of(scene, false);
    rig.until_ms(50);
    rig.arm();
    rig.until_ms(200);
    const bool armed = rig.arming().state != ArmingState::kOff;
    EXPECT_EQ(armed, off_m == 0.0);
    if (!armed) {
      EXPECT_EQ(rig.arming().note, ArmingNote::kInsideWall);
      EXPECT_EQ(rig.peak_n, 0.0);
    }
  }
}

}  // namespace
}  // namespace hapticwall::session::test
