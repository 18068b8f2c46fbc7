// A grid over the corners of the parameters, for every algorithm and integrator: what random scenes
// meet by luck only.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "tests/property/extremes_run.h"

namespace hapticwall {
namespace {

using testing::expect_sound;

struct Numbers {
  double stiffness_n_per_m, mass_kg, damping_n_s_per_m, friction_n, period_s, encoder_m;
};

// A hand that pushes the handle into a wall and takes it out again.
Scene corner(const Numbers& n, double ticks) {
  Scene scene;
  scene.name = "corner";
  scene.sampling.rate_hz = 1.0 / n.period_s;
  scene.duration_s = ticks * n.period_s;
  scene.x().device.mass_kg = n.mass_kg;
  scene.x().device.damping_n_s_per_m = n.damping_n_s_per_m;
  scene.x().device.friction_n = n.friction_n;
  scene.x().device.encoder_m = n.encoder_m;
  scene.x().device.start_m = 0.049;
  scene.x().walls = {{.position_m = 0.05, .stiffness_n_per_m = n.stiffness_n_per_m}};
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 300.0;
  scene.x().hand->damping_n_s_per_m = 5.0;
  scene.x().hand->path = {{0.0, 0.049}, {ticks / 2 * n.period_s, 0.06}, {ticks * n.period_s, 0.04}};
  return scene;
}

template <typename Visitor>
void for_each_corner(const Visitor& visitor) {
  for (const double stiffness : {0.0, 1e-3, 1e3, 35e3, 1e9}) {
    for (const double mass : {1e-6, 1e-3, 0.05, 1e3}) {
      for (const double damping : {0.0, 1e-6, 1.0, 1e4}) {
        for (const double friction : {0.0, 0.14, 10.0}) {
          for (const double period : {1e-5, 1e-3, 0.1}) {
            for (const double encoder : {0.0, 1e-9, 0.254e-3, 0.01}) {
              visitor(Numbers{stiffness, mass, damping, friction, period, encoder});
            }
          }
        }
      }
    }
  }
}

using Choice = std::tuple<std::size_t, Integrator>;
class ExtremeGrid : public ::testing::TestWithParam<Choice> {};

TEST_P(ExtremeGrid, EveryCornerIsSound) {
  constexpr double kTicks = 20.0;
  for_each_corner([](const Numbers& numbers) {
    if (HasFailure()) return;
    Scene scene = corner(numbers, kTicks);
    scene.algorithm.index = std::get<0>(GetParam());
    scene.simulator = {std::get<1>(GetParam()),
                       std::get<1>(GetParam()) == Integrator::kExact ? 1 : 3};
    for (const double limit_n : {0.0, 8.9, 1e6}) {
      scene.x().device.force_limit_n = limit_n;
      (void)expect_sound(scene);
    }
    scene.x().device.force_limit_n.reset();
    (void)expect_sound(scene);
  });
}

// The parts between command and handle, alone and together, from one end to the other.
TEST_P(ExtremeGrid, EveryOutputIsSound) {
  constexpr double kTicks = 60.0;
  for (const int delay : {0, 1, 30, kMaxDelayTicks}) {
    for (const double lag_s : {0.0, 1e-9, 1e-3, 10.0}) {
      for (const double resolution_n : {0.0, 1e-12, 0.1, 1e3}) {
        for (const double grip : {-1.0, 0.0, 1e3, 1e9}) {
          Scene scene = corner({1e5, 0.05, 1.0, 0.14, 1e-3, 0.254e-3}, kTicks);
          if (grip >= 1e9) scene.x().device.friction_n.reset();  // its swing would take real time
          scene.x().device.force_limit_n = 8.9;
          scene.x().device.delay_ticks = delay;
          scene.x().device.amplifier_time_constant_s = lag_s;
          scene.x().device.force_resolution_n = resolution_n;
          if (grip >= 0.0) {
            scene.x().hand->mass_kg = 0.4;
            scene.x().hand->grip_stiffness_n_per_m = grip;
          }
          scene.algorithm.index = std::get<0>(GetParam());
          scene.simulator = {std::get<1>(GetParam()),
                             std::get<1>(GetParam()) == Integrator::kExact ? 1 : 3};
          (void)expect_sound(scene);
          if (HasFailure()) return;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, ExtremeGrid,
                         ::testing::Combine(::testing::Range<std::size_t>(0, algorithms().size()),
                                            ::testing::Values(Integrator::kExact,
                                                              Integrator::kSemiImplicitEuler,
                                                              Integrator::kRungeKutta4)),
                         [](const auto& param_info) {
                           std::string name(algorithms()[std::get<0>(param_info.param)].name);
                           name += "_";
                           name += kIntegratorNames.at(
                               static_cast<std::size_t>(std::get<1>(param_info.param)));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace hapticwall
