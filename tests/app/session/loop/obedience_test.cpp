// Hands that press into a wall with a handle that obeys, and with one whose force has the other
// sign.
#include "app/session/loop/obedience.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <ostream>
#include <string_view>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/plant/plant_model.h"
#include "core/scene.h"
#include "core/tick/servo.h"
#include "device/device.h"

namespace hapticwall::session {
namespace {

using Word = Obedience::Word;

const double kUntriedShare = device::DeviceInfo{}.untried_share;

struct Lived {
  Word word = Word::kUnknown;
  double after_s = 0.0;  // since the first force
  double peak_n = 0.0;   // max until after_s
  double way_m = 0.0;    // into the wall, until then
};

// A plant with one tick of delay more than the hold.
struct PlantDevice {
  PlantModel& plant;
  double sign;
  std::deque<double> commands_n{0.0};
  DeviceReading reading{};

  void pass() {
    plant.advance(sign * commands_n.front());
    commands_n.pop_front();
    reading.position_m = plant.measured_position_m();
  }
  [[nodiscard]] DeviceReading read() const { return reading; }
  void write(double force_n) { commands_n.push_back(force_n); }
};

Lived live(const Scene& scene, double sign, double duration_s) {
  PlantModel plant(scene);
  Servo servo(servo_settings(scene));
  PlantDevice device{plant, sign};
  Obedience obedience(scene.x().device.encoder_m.value_or(0.0), scene.sampling.rate_hz,
                      kUntriedShare);
  obedience.begin();
  Lived lived;
  int first = -1;
  for (int tick = 0; tick < duration_s * scene.sampling.rate_hz; ++tick) {
    device.pass();
    obedience.hear(device.reading.position_m, servo.state().previous_force_n, 2e-3);
    lived.word = obedience.word();
    lived.after_s = first < 0 ? 0.0 : (tick - first) / scene.sampling.rate_hz;
    if (lived.word != Word::kUnknown) break;
    servo.state().limit_share = obedience.limit_share();
    servo.state().level = obedience.level();
    const Sample sample = servo.tick(device);
    if (sample.force_n != 0.0 && first < 0) first = tick;
    lived.peak_n = std::max(lived.peak_n, std::abs(sample.force_n));
    lived.way_m = std::max(lived.way_m, sample.penetration_m);
  }
  return lived;
}

Scene scene_of(std::string_view name) { return file::load_scene(std::string(name))->scene; }

class ObeyingHand : public ::testing::TestWithParam<std::string_view> {};

TEST_P(ObeyingHand, ObeysUnderEveryAlgorithm) {
  Scene scene = scene_of(GetParam());
  for (std::size_t algorithm = 0; algorithm < first_plugin(); ++algorithm) {
    scene.algorithm = {};
    scene.algorithm.index = algorithm;
    for (const double encoder_m : {2e-6, 20e-6}) {
      scene.x().device.encoder_m = encoder_m;
      const Lived lived = live(scene, 1.0, 6.0);
      EXPECT_EQ(lived.word, Word::kObeys) << algorithms()[algorithm].name << " " << encoder_m;
      EXPECT_LT(lived.after_s, 1.2) << algorithms()[algorithm].name << " " << encoder_m;
    }
  }
}

TEST_P(ObeyingHand, AWrongSignNeverGetsMoreThanAWeakForce) {
  Scene scene = scene_of(GetParam());
  for (std::size_t algorithm = 0; algorithm < first_plugin(); ++algorithm) {
    scene.algorithm = {};
    scene.algorithm.index = algorithm;
    for (const double encoder_m : {2e-6, 20e-6, 254e-6}) {
      scene.x().device.encoder_m = encoder_m;
      const Lived lived = live(scene, -1.0, 6.0);
      EXPECT_NE(lived.word, Word::kObeys) << algorithms()[algorithm].name << " " << encoder_m;
      EXPECT_LE(lived.peak_n, kMaxUntriedShare * *scene.x().device.force_limit_n + 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ObeyingHand,
                         ::testing::Values("press", "tap", "tap-slow", "light"));

TEST(Obedience, WithoutATrialTheWholeForceIsThereAtOnce) {
  Obedience obedience(1e-6, 1000.0, 1.0);
  obedience.begin();
  EXPECT_EQ(obedience.word(), Word::kObeys);
  EXPECT_EQ(obedience.limit_share(), 1.0);
  EXPECT_EQ(obedience.level(), 1.0);
}

TEST(Obedience, InFreeSpaceNothingIsLearnt) {
  Obedience obedience(1e-6, 1000.0, kUntriedShare);
  obedience.begin();
  for (int tick = 0; tick < 5000; ++tick) obedience.hear(0.01 * std::sin(0.01 * tick), 0.0, 0.0);
  EXPECT_EQ(obedience.word(), Word::kUnknown);
  EXPECT_EQ(obedience.limit_share(), kUntriedShare);
}

// The full force comes within 0.2 s, and not at once.
TEST(Obedience, AfterTheTrialTheForceRises) {
  Obedience obedience(1e-6, 1000.0, kUntriedShare);
  obedience.begin();
  double place_m = 0.06;
  double share = obedience.limit_share();
  int rises = 0;
  for (int tick = 0; tick < 3000; ++tick) {
    const double force_n = 10.0 * obedience.limit_share() * obedience.level();
    place_m += (0.06 - force_n * 2e-3 - place_m) * 0.05;  // a spring
    obedience.hear(place_m, force_n, 0.0);
    if (obedience.word() != Word::kObeys) continue;
    rises += share < 1.0 ? 1 : 0;
    EXPECT_LE(obedience.limit_share() - share, 1.0 / (kObeyedRampS * 1000.0) + 1e-12);
    share = obedience.limit_share();
  }
  EXPECT_EQ(share, 1.0);
  EXPECT_NEAR(rises, 180, 5);
  obedience.begin();
  EXPECT_EQ(obedience.limit_share(), kUntriedShare);
}

}  // namespace
}  // namespace hapticwall::session
