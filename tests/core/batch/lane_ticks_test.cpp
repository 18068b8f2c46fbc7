// The lanes tick by tick: a summary does not show the sign of a zero force.
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/batch/lane_block.h"
#include "core/batch/lane_scene.h"
#include "core/plant/plant_model.h"
#include "core/simulation/simulate.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/batch_support.h"
#include "tests/samples.h"

namespace hapticwall {
namespace {

constexpr std::uint64_t kTicks = 2000;

// A hand that leans on a wall from the first tick on: contacts, rests and reversals.
Scene lean(std::size_t algorithm, std::size_t number) {
  Scene scene;
  scene.duration_s = static_cast<double>(kTicks) / scene.sampling.rate_hz;
  scene.x().device.start_m = 0.049;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().hand = HandSettings{};
  scene.x().hand->stiffness_n_per_m = 50.0;
  scene.x().hand->damping_n_s_per_m = 0.5;
  scene.x().hand->path = {{0.0, 0.049 + 0.0002 * static_cast<double>(number)}};
  scene.x().walls = {{0.05, 2000.0 * static_cast<double>(number + 1), 0.0}};
  scene.algorithm.index = algorithm;
  return scene;
}

void set_resting_lane(const Scene& scene, std::size_t lane, batch::LaneBlock& block) {
  batch::set_lane(scene, OneBody(plant_parameters(scene), scene.sampling.period_s()), lane, block);
  block.parameters.path_m[lane] = hand_path(scene).position_m();
}

void expect_the_scalar_bits(std::size_t algorithm) {
  batch::LaneBlock block;
  std::vector<std::vector<Sample>> wanted;
  for (std::size_t lane = 0; lane < batch::lane_count(); ++lane) {
    const Scene scene = lean(algorithm, lane);
    set_resting_lane(scene, lane, block);
    wanted.push_back(testing::samples_of(scene));
    ASSERT_EQ(wanted.back().size(), kTicks);
  }
  const auto kind = batch::lane_kind(lean(algorithm, 0)).value();
  const batch::LaneParts parts{.algorithm = kind.algorithm, .encoder = true};
  for (std::uint64_t tick = 0; tick < kTicks; tick += batch::kTraceTicks) {
    ASSERT_EQ(run_lanes(block, parts, tick, tick + batch::kTraceTicks), tick + batch::kTraceTicks);
    for (std::size_t row = 0; row < batch::kTraceTicks; ++row) {
      for (std::size_t lane = 0; lane < wanted.size(); ++lane) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(block.trace.force_n[row][lane]),
                  std::bit_cast<std::uint64_t>(wanted[lane][tick + row].force_n))
            << algorithms()[algorithm].name << ", tick " << tick + row << ", lane " << lane;
      }
    }
  }
}

TEST(LaneTicks, EveryForceHasTheScalarBits) {
  for (const std::int64_t target : testing::lane_targets()) {
    const testing::OnlyTarget only(target);
    for (std::size_t i = 0; i < algorithms().size(); ++i) expect_the_scalar_bits(i);
  }
}

}  // namespace
}  // namespace hapticwall
