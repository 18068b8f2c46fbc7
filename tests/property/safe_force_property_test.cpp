// Always a safe force: whatever the scene, whatever somebody changes while it runs, whatever the
// device does.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <cstdio>
#include <string_view>

#include "tests/property/safe_force.h"

namespace hapticwall {
namespace {

using testing::FaultyDevice;
using testing::FaultySimulator;
using testing::Life;
using testing::LifeTotals;
using testing::random_scene;

constexpr int kLivesOfAScene = 3;

Scene any_scene() {
  const auto index = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::size_t>(0, 1000));
  return random_scene(algorithms()[index % algorithms().size()].name);
}

std::uint64_t any_seed() {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>());
}

void tell(std::string_view kind, const LifeTotals& totals) {
  std::printf(
      "%.*s: %llu lives, %llu cycles; with force %llu, at the limit %llu, in the ramp %llu; %llu "
      "changes under force; %llu armings, %llu bad readings, %llu absurd ones, %llu holes, %llu "
      "exceptions; taken "
      "away %llu times\n",
      static_cast<int>(kind.size()), kind.data(), static_cast<unsigned long long>(totals.lives),
      static_cast<unsigned long long>(totals.cycles),
      static_cast<unsigned long long>(totals.ticks_with_force),
      static_cast<unsigned long long>(totals.ticks_at_limit),
      static_cast<unsigned long long>(totals.ticks_in_ramp_with_force),
      static_cast<unsigned long long>(totals.changes_under_force),
      static_cast<unsigned long long>(totals.armings),
      static_cast<unsigned long long>(totals.faults),
      static_cast<unsigned long long>(totals.absurd_positions),
      static_cast<unsigned long long>(totals.holes),
      static_cast<unsigned long long>(totals.exceptions),
      static_cast<unsigned long long>(totals.forces_taken_away));
}

TEST(SafeForce, OnARealDeviceThatFailsInEveryWay) {
  constexpr int kCycles = 6000;
  LifeTotals totals;
  EXPECT_TRUE(rc::check([&] {
    Scene scene = any_scene();
    scene.x().hand.reset();  // a person's own is there
    const std::uint64_t seed = any_seed();
    for (std::uint64_t i = 0; i < kLivesOfAScene; ++i) {
      FaultyDevice device;
      Life<FaultyDevice>(scene, seed + i, device, totals).live(kCycles);
    }
  }));
  tell("real device", totals);
  EXPECT_GT(totals.ticks_with_force, totals.cycles / 20);
  EXPECT_GT(totals.ticks_at_limit, 1000U);
  EXPECT_GT(totals.ticks_in_ramp_with_force, 1000U);
  EXPECT_GT(totals.changes_under_force, 1000U);
  EXPECT_GT(totals.armings, 100U);
  EXPECT_GT(totals.faults, 1000U);
  EXPECT_GT(totals.holes, 100U);
  EXPECT_GT(totals.absurd_positions, 10U);
  EXPECT_GT(totals.exceptions, 20U);
  EXPECT_GT(totals.forces_taken_away, 100U);
}

TEST(SafeForce, OnASimulator) {
  constexpr int kCycles = 2000;
  LifeTotals totals;
  EXPECT_TRUE(rc::check([&] {
    const Scene scene = any_scene();
    const std::uint64_t seed = any_seed();
    for (std::uint64_t i = 0; i < kLivesOfAScene; ++i) {
      FaultySimulator device(scene);
      Life<FaultySimulator>(scene, seed + i, device, totals).live(kCycles);
    }
  }));
  tell("simulator", totals);
  EXPECT_GT(totals.ticks_with_force, totals.cycles / 20);
  EXPECT_GT(totals.ticks_at_limit, 1000U);
  EXPECT_GT(totals.changes_under_force, 1000U);
  EXPECT_GT(totals.exceptions, 3U);
}

}  // namespace
}  // namespace hapticwall
