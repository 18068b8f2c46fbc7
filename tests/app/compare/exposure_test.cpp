// The exposure of a trial, against the plant's own integrals and by hand.
#include "app/compare/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/run/simulate.h"

namespace hapticwall::compare {
namespace {

Tick tick_at(std::uint64_t number, double position_m, double force_n) {
  Tick tick;
  tick.axes[0].tick = number;
  tick.axes[0].position_m = position_m;
  tick.axes[0].force_n = force_n;
  tick.axes[0].flags = force_n != 0.0 ? kFlagInContact : 0U;
  return tick;
}

TEST(Exposure, SumsWhatTheHandMeets) {
  Exposure exposure;
  exposure.begin();
  exposure.add(tick_at(10, 0.0, 0.0), 0.5);
  exposure.add(tick_at(11, 0.01, 2.0), 0.5);
  exposure.add(tick_at(12, 0.02, 4.0), 0.5);  // 2 N held over 10 mm into the wall
  exposure.add(tick_at(13, 0.0, 0.0), 0.5);   // 4 N held over 20 mm out of it
  exposure.add(tick_at(14, 0.01, -3.0), 0.5);
  const file::ExposureRow row = exposure.row();
  EXPECT_EQ(row.contact_s, 1.5);
  EXPECT_EQ(row.mean_force_n, 3.0);
  EXPECT_EQ(row.max_force_n, 4.0);
  EXPECT_DOUBLE_EQ(row.energy_to_hand_j, -0.02 + 0.08);
  EXPECT_EQ(row.touches, 2U);
  EXPECT_EQ(row.lost_ticks, 0U);
  EXPECT_EQ(row.first_tick, 10U);
  EXPECT_EQ(row.last_tick, 14U);
}

TEST(Exposure, OfNoTickIsEmpty) { EXPECT_EQ(Exposure().row(), file::ExposureRow()); }

TEST(Exposure, AGapGivesNoWorkAndIsCounted) {
  Exposure exposure;
  exposure.add(tick_at(10, 0.0, 1.0), 1e-3);
  exposure.add(tick_at(15, 0.5, 1.0), 1e-3);
  exposure.add(tick_at(0, 0.0, 1.0), 1e-3);  // a reset
  EXPECT_EQ(exposure.row().energy_to_hand_j, 0.0);
  EXPECT_EQ(exposure.row().lost_ticks, 4U);
  EXPECT_EQ(exposure.row().touches, 1U);
}

TEST(Exposure, TwoAxesAreOneForce) {
  Tick tick = tick_at(0, 0.0, 3.0);
  tick.count = 2;
  tick.axes[1].force_n = 4.0;
  Exposure exposure;
  exposure.add(tick, 1e-3);
  EXPECT_EQ(exposure.row().max_force_n, 5.0);
}

// The reference is the actuator's work that the plant integrates; the encoder of this scene has no
// steps.
TEST(Exposure, ItsEnergyIsTheWorkOfTheActuator) {
  const std::vector<std::string> overrides{"device.encoder_m=0"};
  const Scene scene = file::load_scene("press", overrides)->scene;
  for (const char* algorithm : {"none", "energy-bounding"}) {
    Exposure exposure;
    double work_j = 0.0;
    AxesOptions options;
    options.on_tick = [&](const Tick& tick) {
      exposure.add(tick, scene.sampling.period_s());
      work_j = tick.x().truth.actuator_work_j;
    };
    const std::vector<std::string> with{"device.encoder_m=0",
                                        std::string("algorithm=") + algorithm};
    static_cast<void>(simulate_axes(file::load_scene("press", with)->scene, options));
    EXPECT_GT(exposure.row().contact_s, 0.5);
    EXPECT_GE(exposure.row().touches, 1U);
    EXPECT_NEAR(exposure.row().energy_to_hand_j, -work_j, 1e-9) << algorithm;
  }
}

}  // namespace
}  // namespace hapticwall::compare
