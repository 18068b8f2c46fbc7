// A minute at the wall in virtual time with faults: the same bits in every run.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "core/tick/servo.h"
#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using hid::FaultKind;
using testing::kMillisecondUs;
using testing::Rig;

constexpr std::uint64_t kMinuteMs = 60'000;

// A hand that presses into a wall at 50 mm and lets go, every two seconds.
Scene pressing_scene() {
  Scene scene = hid::testing::held_scene();
  scene.x().hand->path = {};
  for (int second = 0; second < 60; second += 2) {
    scene.x().hand->path.edit().push_back({second + 0.0, 0.03});
    scene.x().hand->path.edit().push_back({second + 1.0, 0.06});
  }
  WallSettings wall;
  wall.position_m = 0.05;
  wall.stiffness_n_per_m = 1000.0;
  scene.x().walls = {wall};
  scene.x().device.encoder_m = 1e-5;
  return scene;
}

// View of the link in the servo step.
struct OneAxis {
  AxesReading reading;
  double force_n = 0.0;

  [[nodiscard]] DeviceReading read() const {
    DeviceReading one;
    one.position_m = reading.position_m[0];
    one.age_s = reading.age_s;
    one.state = reading.state;
    return one;
  }
  void write(double wanted_n) { force_n = wanted_n; }
};

struct Outcome {
  std::uint64_t digest = 14695981039346656037ULL;
  int contacts = 0;
  LinkStats stats;

  void add(std::uint64_t value) { digest = (digest ^ value) * 1099511628211ULL; }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
};

Outcome minute() {
  const Scene scene = pressing_scene();
  hid::EmulatorSettings settings;
  settings.axes = {scene};
  Rig rig({{FaultKind::kBadCrc, 5'000 * kMillisecondUs, 5'000 * kMillisecondUs, 7},
           {FaultKind::kSkipped, 12'000 * kMillisecondUs, 3'000 * kMillisecondUs, 3},
           {FaultKind::kUnplugged, 20'000 * kMillisecondUs, 700 * kMillisecondUs},
           {FaultKind::kEmergencyStop, 30'000 * kMillisecondUs, 500 * kMillisecondUs},
           {FaultKind::kNoOutput, 40'000 * kMillisecondUs, 300 * kMillisecondUs}},
          {}, settings);
  Servo servo(servo_settings(scene));
  Outcome outcome;
  rig.host.law = [&](const AxesReading& reading) -> AxisValues {
    OneAxis axis{reading};
    const Sample sample = servo.tick(axis);
    outcome.contacts += (sample.flags & kFlagInContact) != 0 ? 1 : 0;
    outcome.add(sample.position_m);
    outcome.add(sample.force_n);
    return {axis.force_n, 0.0};
  };
  rig.host.on_report = [&](const hid::ReportBytes& bytes) {
    for (const std::uint8_t byte : bytes) outcome.add(std::uint64_t{byte});
  };
  while (rig.host.now_us() < kMinuteMs * kMillisecondUs) {
    rig.host.tick();
    if (rig.host.last.state == DeviceState::kOk) rig.host.arm();
    outcome.add(rig.force_n());
    outcome.add(rig.plug.device.truth(0).position_m);
  }
  outcome.stats = rig.host.stats();
  return outcome;
}

TEST(LinkMinute, GivesTheSameBitsInEveryRun) {
  const Outcome first = minute();
  const Outcome second = minute();
  EXPECT_EQ(first.digest, second.digest);
  EXPECT_GT(first.contacts, 10'000);
  EXPECT_EQ(first.stats.losses, 1U);
  EXPECT_EQ(first.stats.void_reports, 715U);            // 5000 ticks, every seventh
  EXPECT_EQ(first.stats.missing_states, 715U + 1000U);  // and 3000 ticks, every third
  EXPECT_EQ(first.stats.trouble, Trouble::kNone);
  EXPECT_GT(first.stats.states, 57'000U);
}

}  // namespace
}  // namespace hapticwall::device
