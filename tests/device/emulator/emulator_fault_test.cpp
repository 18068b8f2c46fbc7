// Each scripted fault happens, and the force ends within the promised time, even if the host
// notices nothing and keeps pushing.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/tick/servo.h"
#include "device/simulated_device.h"
#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid {
namespace {

using testing::Bench;
using testing::kLimitN;
using testing::kMillisecondUs;
using testing::kTickUs;

constexpr std::uint64_t kBeginUs = 200 * kMillisecondUs;
constexpr std::uint64_t kTimeToLiveUs = kUsualTimeToLiveMs * kMillisecondUs;
constexpr std::uint64_t kWatchdogUs = 50 * kMillisecondUs;
constexpr std::uint64_t kBusLossUs = 3 * kMillisecondUs;
// The echo of a host without new states grows older than a force may live; then its last command
// must expire.
constexpr std::uint64_t kBlindHostUs = 2 * kTimeToLiveUs;

struct Promise {
  FaultKind kind;
  std::uint64_t within_us;
};

class ForceIsGone : public ::testing::TestWithParam<Promise> {};

TEST_P(ForceIsGone, WithinTheTimePromised) {
  const auto [kind, within_us] = GetParam();
  Bench bench({{kind, kBeginUs, 1000 * kMillisecondUs}});
  const auto pass = [&] {  // a host five times faster than the device, so that times show
    bench.step(kTickUs / 5);
    bench.push(kLimitN);
  };
  while (bench.device.now_us() < kBeginUs - kTickUs) pass();
  ASSERT_EQ(bench.force_n(), kLimitN);
  std::uint64_t last_force_us = bench.device.now_us();
  while (bench.device.now_us() < kBeginUs + 1000 * kMillisecondUs - kTickUs) {
    pass();
    if (bench.force_n() != 0.0) last_force_us = bench.device.now_us();
  }
  EXPECT_LE(last_force_us, kBeginUs + within_us + kTickUs);
  // It does not end much earlier: this tests the promised time, not another one.
  EXPECT_GE(last_force_us + kBusLossUs, kBeginUs + within_us);
}

INSTANTIATE_TEST_SUITE_P(
    EmulatorFault, ForceIsGone,
    ::testing::Values(
        Promise{FaultKind::kEmpty, kBlindHostUs}, Promise{FaultKind::kShort, kBlindHostUs},
        Promise{FaultKind::kOverLong, kBlindHostUs}, Promise{FaultKind::kWrongId, kBlindHostUs},
        Promise{FaultKind::kWrongMajor, kBlindHostUs}, Promise{FaultKind::kBadCrc, kBlindHostUs},
        Promise{FaultKind::kAllZero, kBlindHostUs}, Promise{FaultKind::kSkipped, kBlindHostUs},
        Promise{FaultKind::kRepeated, kBlindHostUs}, Promise{FaultKind::kSilent, kBlindHostUs},
        Promise{FaultKind::kNotPolled, kBlindHostUs}, Promise{FaultKind::kNoOutput, kTimeToLiveUs},
        Promise{FaultKind::kUnplugged, kBusLossUs}, Promise{FaultKind::kFrozen, kWatchdogUs},
        Promise{FaultKind::kRestart, 0}, Promise{FaultKind::kEmergencyStop, 0},
        Promise{FaultKind::kOverTemperature, 0}, Promise{FaultKind::kOverCurrent, 0},
        Promise{FaultKind::kEncoderFault, 0}),
    [](const auto& tested) {
      return "Kind" + std::to_string(static_cast<int>(tested.param.kind));
    });

TEST(EmulatorFault, AHostThatStallsForASecondLosesTheForceAndFindsAFault) {
  Bench bench;
  bench.drive(kLimitN, 100);
  bench.ticks(21);
  EXPECT_EQ(bench.force_n(), 0.0);
  bench.ticks(979);
  bench.drive(kLimitN, 10);
  EXPECT_EQ(bench.force_n(), 0.0);
  EXPECT_TRUE(bench.has(kStatusWatchdog));
}

Refusal refusal_of(const InputReport& report) {
  const auto decoded = decode_state(report.view());
  EXPECT_NE(decoded.refusal(), nullptr);
  return decoded.refusal() == nullptr ? Refusal::kValue : *decoded.refusal();
}

TEST(EmulatorFault, SpoiltReportsAreSpoiltAsTheScriptSaysAndOnlyThose) {
  constexpr std::pair<FaultKind, Refusal> kSpoilt[] = {
      {FaultKind::kEmpty, Refusal::kLength},       {FaultKind::kShort, Refusal::kLength},
      {FaultKind::kOverLong, Refusal::kLength},    {FaultKind::kWrongId, Refusal::kId},
      {FaultKind::kAllZero, Refusal::kId},         {FaultKind::kBadCrc, Refusal::kCrc},
      {FaultKind::kWrongMajor, Refusal::kProtocol}};
  for (const auto& [kind, refusal] : kSpoilt) {
    Bench bench({{kind, 10 * kMillisecondUs, 20 * kMillisecondUs, 4}});
    bench.ticks(50);
    ASSERT_EQ(bench.reports.size(), 50U);
    for (std::size_t i = 0; i < bench.reports.size(); ++i) {
      const std::size_t tick = i + 1;
      if (tick >= 10 && tick < 30 && (tick - 10) % 4 == 0) {
        ASSERT_EQ(refusal_of(bench.reports[i]), refusal) << tick;
      } else {
        ASSERT_EQ(decode_state(bench.reports[i].view()).report()->sequence, tick);
      }
    }
  }
}

TEST(EmulatorFault, SkippedReportsLeaveAGapInTheSequence) {
  Bench bench({{FaultKind::kSkipped, 10 * kMillisecondUs, 2 * kMillisecondUs}});
  bench.ticks(9);
  EXPECT_EQ(bench.state.sequence, 9);
  bench.ticks(3);
  EXPECT_EQ(bench.state.sequence, 12);
  EXPECT_EQ(bench.reports.size(), 10U);
  EXPECT_FALSE(bench.has(kStatusReportOverrun));  // the device does not know
}

TEST(EmulatorFault, ARepeatedReportIsTheOneBeforeOnceMore) {
  Bench bench({{FaultKind::kRepeated, 10 * kMillisecondUs, 2 * kMillisecondUs}});
  bench.ticks(12);
  ASSERT_EQ(bench.reports.size(), 12U);
  EXPECT_EQ(bench.reports[9].bytes, bench.reports[8].bytes);
  EXPECT_EQ(bench.reports[10].bytes, bench.reports[8].bytes);
  EXPECT_EQ(bench.state.sequence, 12);
}

TEST(EmulatorFault, ASilentDeviceStillListens) {
  Bench bench({{FaultKind::kSilent, 10 * kMillisecondUs, 30 * kMillisecondUs}});
  bench.drive(1.0, 9);
  bench.drive(2.0, 20);
  EXPECT_EQ(bench.state.sequence, 9);
  EXPECT_EQ(bench.force_n(), 2.0);
}

TEST(EmulatorFault, WithAnEncoderFaultTheCountsStandStill) {
  Bench bench({{FaultKind::kEncoderFault, 100 * kMillisecondUs, 100 * kMillisecondUs}});
  bench.drive(2.0, 99);
  const std::int32_t before = bench.state.position_counts[0];
  bench.ticks(100);  // the force is gone, the handle swings back
  EXPECT_EQ(bench.state.position_counts[0], before);
  bench.tick();
  EXPECT_NE(bench.state.position_counts[0], before);
}

TEST(EmulatorFault, TheSameCallsGiveTheSameBytes) {
  const FaultScript script{{FaultKind::kBadCrc, 10 * kMillisecondUs, 90 * kMillisecondUs, 3},
                           {FaultKind::kUnplugged, 200 * kMillisecondUs, 50 * kMillisecondUs}};
  Bench one(script);
  Bench other(script);
  for (int i = 0; i < 400; ++i) {
    one.drive(std::sin(i));
    other.drive(std::sin(i));
  }
  ASSERT_EQ(one.reports.size(), other.reports.size());
  for (std::size_t i = 0; i < one.reports.size(); ++i) {
    ASSERT_EQ(one.reports[i].bytes, other.reports[i].bytes);
    ASSERT_EQ(one.reports[i].size, other.reports[i].size);
  }
}

// The wall of the paper through reports and back.
class ThroughReports {
 public:
  explicit ThroughReports(const Scene& scene) : bench_(settings_of(scene)) { bench_.tick(); }

  [[nodiscard]] DeviceReading read() const {
    return {bench_.state.position_counts[0] * testing::kEncoderM, 0.0, DeviceState::kOk};
  }
  void write(double force_n) { bench_.drive(-force_n); }
  [[nodiscard]] static const PlantTruth* truth() { return nullptr; }

 private:
  static EmulatorSettings settings_of(const Scene& scene) {
    EmulatorSettings settings;
    settings.axes = {scene};
    return settings;
  }
  Bench bench_;
};

Scene press(std::size_t algorithm) {
  Scene scene = testing::held_scene();
  scene.x().hand->mass_kg = 0.4;
  scene.x().hand->damping_n_s_per_m = 33.0;
  scene.x().hand->grip_stiffness_n_per_m = 1000.0;
  scene.x().hand->grip_damping_n_s_per_m = 1.0;
  scene.x().hand->path = {{0.0, 0.03}, {1.5, 0.075}};
  scene.x().walls = {{0.05, 35000.0, 0.0}};
  scene.algorithm.index = algorithm;
  return scene;
}

// With one tick of output delay and a force resolution of 1 mN, the simulator equals the emulated
// device.
TEST(EmulatorAgainstSimulator, GivenItsDelayTheSimulatorDoesTheSameToTheLastBit) {
  for (std::size_t algorithm = 0; algorithm < algorithms().size(); ++algorithm) {
    const Scene scene = press(algorithm);
    Scene direct = scene;
    direct.x().device.delay_ticks = 1;
    direct.x().device.force_resolution_n = 1e-3;
    ThroughReports through(scene);
    SimulatedDevice simulated(direct);
    static_cast<void>(simulated.read());
    simulated.write(0.0);  // the first report comes one tick after the start
    Servo servo(servo_settings(scene));
    Servo reference(servo_settings(scene));
    int contacts = 0;
    for (int tick = 0; tick < 5000; ++tick) {
      const Sample a = servo.tick(through);
      const Sample b = reference.tick(simulated);
      contacts += (b.flags & kFlagInContact) != 0 ? 1 : 0;
      ASSERT_EQ(a.position_m, b.position_m) << algorithms()[algorithm].name << ' ' << tick;
      ASSERT_EQ(a.force_n, b.force_n) << algorithms()[algorithm].name << ' ' << tick;
    }
    EXPECT_GT(contacts, 500) << algorithms()[algorithm].name;
  }
}

}  // namespace
}  // namespace hapticwall::device::hid
