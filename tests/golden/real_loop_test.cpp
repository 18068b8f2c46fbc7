// Loops and devices that are not ideal: skipped ticks, uneven periods, noise, and friction that
// falls with the speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/chance.h"
#include "core/plant/output_stage.h"
#include "core/run/simulate.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

Scene built_in(std::string_view name, const std::vector<std::string>& settings = {}) {
  return file::load_scene(std::string(name), settings)->scene;
}

// The loop at a third of the rate, without a delay, is the same controller with the same plant.
TEST(SkippedTicks, EveryThirdTickIsTheLoopAtAThirdOfTheRate) {
  for (const AlgorithmDescription& algorithm : algorithms()) {
    Scene often = built_in("golden-soft", {"algorithm.name=" + std::string(algorithm.name),
                                           "sampling.rate_hz=3000", "sampling.render_every=3"});
    Scene seldom = often;
    seldom.sampling = {};
    const std::vector<Sample> each = testing::samples_of(often);
    const std::vector<Sample> third = testing::samples_of(seldom);
    ASSERT_EQ(each.size(), 3 * third.size());
    for (std::size_t k = 0; k < third.size(); ++k) {
      ASSERT_NEAR(each[3 * k].truth.position_m, third[k].truth.position_m, 1e-11)
          << algorithm.name << " " << k;
      ASSERT_EQ(each[3 * k].force_n, each[3 * k + 2].force_n) << algorithm.name << " " << k;
    }
  }
}

// Runs of the same force have the lengths of a coin that is thrown for each tick.
TEST(SkippedTicks, LostOnesHoldTheForceAsOftenAsTheSceneSays) {
  const std::vector<Sample> samples =
      testing::samples_of(built_in("golden-soft", {"sampling.lost_ticks=0.25", "duration_s=20",
                                                   "device.position_noise_m=1e-6"}));
  int held = 0;
  int twice = 0;
  for (std::size_t k = 2; k < samples.size(); ++k) {
    const bool now = samples[k].velocity_m_per_s == samples[k - 1].velocity_m_per_s;
    const bool before = samples[k - 1].velocity_m_per_s == samples[k - 2].velocity_m_per_s;
    held += now ? 1 : 0;
    twice += now && before ? 1 : 0;
  }
  const auto count = static_cast<double>(samples.size());
  EXPECT_NEAR(held / count, 0.25, 0.015);
  EXPECT_NEAR(twice / count, 0.0625, 0.01);
}

TEST(SkippedTicks, AreTheSameOnBothAxes) {
  const Scene scene =
      built_in("corner", {"sampling.lost_ticks=0.3", "device.encoder_m=0", "device.y.encoder_m=0",
                          "device.position_noise_m=1e-6", "device.y.position_noise_m=1e-6"});
  std::vector<std::array<double, 2>> velocities;
  AxesOptions options;
  options.on_tick = [&](const Tick& tick) {
    velocities.push_back({tick.axes[0].velocity_m_per_s, tick.axes[1].velocity_m_per_s});
  };
  static_cast<void>(simulate_axes(scene, options));
  int lost = 0;
  for (std::size_t k = 1; k < velocities.size(); ++k) {
    const bool on_x = velocities[k][0] == velocities[k - 1][0];
    ASSERT_EQ(on_x, velocities[k][1] == velocities[k - 1][1]) << k;
    lost += on_x ? 1 : 0;
  }
  EXPECT_GT(lost, 1000);
}

// A swing without a wall does not feel the ticks: it is that of the true time.
TEST(UnevenPeriods, TakeTheTimeThatTheyHave) {
  Scene scene;
  scene.duration_s = 0.5;
  scene.sampling.jitter = 0.7;
  scene.sampling.seed = 11;
  scene.x().device.start_m = 0.0;
  scene.x().hand = HandSettings{};
  scene.x().hand->stiffness_n_per_m = 200.0;
  scene.x().hand->path = {{0.0, 0.01}};
  const double decay = 0.5 * scene.x().device.damping_n_s_per_m / scene.x().device.mass_kg;
  const double angular = std::sqrt(200.0 / scene.x().device.mass_kg - decay * decay);
  const Chance chance(11, 0, Purpose::kPeriod);
  double now_s = 0.0;
  std::uint64_t tick = 0;
  for (const Sample& sample : testing::samples_of(scene)) {
    const double swing = std::cos(angular * now_s) + decay / angular * std::sin(angular * now_s);
    ASSERT_NEAR(sample.truth.position_m, 0.01 * (1.0 - std::exp(-decay * now_s) * swing), 1e-14)
        << tick;
    now_s += 1e-3 * (1.0 + 0.7 * (2.0 * chance.uniform(tick++) - 1.0));
  }
}

// A bent path, friction, a grip and a lag, against the method of fourth order with small steps.
TEST(UnevenPeriods, AreThoseOfTheStepsOfAnotherMethod) {
  Scene scene = built_in("golden-soft", {"sampling.jitter=0.5", "device.friction_n=0.1",
                                         "device.amplifier_time_constant_s=0.002"});
  scene.x().hand->path = {{0.0, 0.03}, {0.31236, 0.06}, {0.77777, 0.05}};
  scene.duration_s = 1.5;
  const std::vector<Sample> exact = testing::samples_of(scene);
  scene.simulator = {Integrator::kRungeKutta4, 400};
  const std::vector<Sample> stepped = testing::samples_of(scene);
  ASSERT_EQ(exact.size(), stepped.size());
  for (std::size_t k = 0; k < exact.size(); ++k) {
    ASSERT_NEAR(exact[k].truth.position_m, stepped[k].truth.position_m, 2e-7) << k;
    ASSERT_NEAR(exact[k].truth.hand_path_m, stepped[k].truth.hand_path_m, 1e-15) << k;
  }
}

TEST(Noise, OfThePositionHasItsSizeAndDiffersByAxis) {
  const Scene scene = built_in(
      "corner", {"device.position_noise_m=3e-6", "device.y.position_noise_m=3e-6", "duration_s=8"});
  double squares = 0.0;
  double products = 0.0;
  double count = 0.0;
  AxesOptions options;
  options.on_tick = [&](const Tick& tick) {
    const double x = tick.axes[0].position_m - tick.axes[0].truth.position_m;
    const double y = tick.axes[1].position_m - tick.axes[1].truth.position_m;
    squares += x * x;
    products += x * y;
    count += 1.0;
  };
  Scene continuous = scene;
  for (AxisSettings& axis : continuous.axes) axis.device.encoder_m.reset();
  static_cast<void>(simulate_axes(continuous, options));
  ASSERT_GT(count, 1000.0);
  EXPECT_NEAR(std::sqrt(squares / count), 3e-6, 4.0 * 3e-6 / std::sqrt(2.0 * count));
  EXPECT_NEAR(products / count, 0.0, 4.0 * 9e-12 / std::sqrt(count));
}

TEST(Noise, OfTheForceComesAfterDelayAndRounding) {
  Scene scene;
  scene.x().device.force_noise_n = 0.1;
  scene.x().device.force_resolution_n = 1.0;
  scene.x().device.delay_ticks = 1;
  OutputStage output(scene);
  const Chance chance(1, 0, Purpose::kForceNoise);
  EXPECT_EQ(output.pass(2.2), 0.1 * chance.normal(0));
  EXPECT_EQ(output.pass(0.0), 2.0 + 0.1 * chance.normal(1));
  output.reset();
  EXPECT_EQ(output.pass(0.0), 0.1 * chance.normal(0)) << "a reset begins anew";
}

// 0.1 kg, f_c = 0.2 N and f_s = 0.5 N.
DeviceSettings slippery(double damping_n_s_per_m, double stribeck_speed_m_per_s) {
  DeviceSettings device;
  device.mass_kg = 0.1;
  device.damping_n_s_per_m = damping_n_s_per_m;
  device.friction_n = 0.2;
  device.static_friction_n = 0.5;
  device.stribeck_speed_m_per_s = stribeck_speed_m_per_s;
  device.start_m = 0.0;
  return device;
}

// Below its static friction the handle sticks; once loose, friction falls and it goes on.
TEST(StribeckFriction, HoldsAtRestAndFallsWithTheSpeed) {
  Scene scene;
  scene.simulator = {Integrator::kRungeKutta4, 20};
  scene.x().device = slippery(0.0, 0.01);
  scene.x().hand = HandSettings{};
  scene.x().hand->stiffness_n_per_m = 100.0;
  scene.x().hand->path = {{0.0, 0.0}, {1.0, 0.01}};  // 1 N/s
  scene.duration_s = 1.0;
  double loose_n = 0.0;
  double fastest = 0.0;
  for (const Sample& sample : testing::samples_of(scene)) {
    if (sample.truth.velocity_m_per_s == 0.0 && fastest == 0.0) {
      loose_n = std::max(loose_n, sample.truth.hand_force_n);
    }
    fastest = std::max(fastest, sample.truth.velocity_m_per_s);
  }
  EXPECT_NEAR(loose_n, 0.5, 2e-3);
  // With f_c alone the handle would slip at 0.2 N and follow at 0.01 m/s.
  EXPECT_GT(fastest, 0.05);
}

// The equation itself, integrated by halved steps of the midpoint rule in this test.
TEST(StribeckFriction, SlowsAsTheEquationSays) {
  Scene scene;
  scene.simulator = {Integrator::kRungeKutta4, 100};
  scene.x().device = slippery(0.5, 0.05);
  scene.x().hand = HandSettings{};
  scene.x().hand->damping_n_s_per_m = 2.0;
  scene.x().hand->path = {{0.0, 0.0}, {0.2, 0.1}};
  scene.duration_s = 0.2;
  const auto acceleration = [&](double v) {
    const double ratio = v / 0.05;
    const double friction_n = 0.2 + 0.3 / (1.0 + ratio * ratio);
    return (2.0 * (0.5 - v) - 0.5 * v - friction_n) / 0.1;
  };
  double v = 0.0;
  constexpr int kSteps = 20'000;
  constexpr double kStepS = 0.199 / kSteps;
  for (int i = 0; i < kSteps; ++i) v += kStepS * acceleration(v + 0.5 * kStepS * acceleration(v));
  const Sample last = testing::samples_of(scene).back();
  EXPECT_NEAR(last.truth.velocity_m_per_s, v, 1e-7);
  const PlantTruth& truth = last.truth;
  EXPECT_NEAR(truth.hand_work_j, truth.kinetic_j + truth.dissipation_j + truth.actuator_work_j,
              1e-9);
}

TEST(StribeckFriction, IsRefusedWhereItCannotBe) {
  const auto refused = [](const std::vector<std::string>& settings) {
    const auto scene = file::load_scene("press", settings);
    return scene ? std::string() : scene.error().message;
  };
  EXPECT_NE(
      refused({"device.static_friction_n=0.5", "device.stribeck_speed_m_per_s=0.01"}).find("rk4"),
      std::string::npos);
  EXPECT_NE(refused({"device.static_friction_n=0.5", "simulator.integrator=rk4"})
                .find("stribeck_speed_m_per_s is missing"),
            std::string::npos);
  EXPECT_NE(refused({"device.static_friction_n=0.05", "device.friction_n=0.1",
                     "device.stribeck_speed_m_per_s=0.01", "simulator.integrator=rk4"})
                .find("is less than"),
            std::string::npos);
}

}  // namespace
}  // namespace hapticwall
