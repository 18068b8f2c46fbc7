// Two axes are two loops that share the clock: each gives what it would give alone.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

HandSettings hand(double to_m) {
  HandSettings settings;
  settings.stiffness_n_per_m = 250.0;
  settings.damping_n_s_per_m = 3.0;
  settings.path = {{0.0, 0.03}, {0.4, to_m}};
  return settings;
}

Scene corner_scene() {
  Scene scene;
  scene.name = "corner";
  scene.duration_s = 2.5;  // ticks that are no whole number of chunks
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.friction_n = 0.14;
  scene.x().hand = hand(0.07);
  scene.x().walls = {{0.05, 35000.0, 0.0}};
  scene.axes.resize(2);
  scene.axes[1].device.mass_kg = 0.08;
  scene.axes[1].hand = hand(0.06);
  scene.axes[1].walls = {{0.045, 5000.0, 1.0}, {0.05, 9000.0, 0.0}};
  scene.algorithm.index = *find_algorithm("energy-bounding");
  return scene;
}

struct Rows {
  std::vector<double> numbers;
  void add(const Sample& sample) {
    for (const double value : {static_cast<double>(sample.tick), sample.position_m, sample.force_n,
                               sample.energy_scv_j, sample.truth.position_m}) {
      numbers.push_back(value);
    }
  }
};

void expect_same_bits(const Rows& a, const Rows& b) {
  ASSERT_EQ(a.numbers.size(), b.numbers.size());
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a.numbers[i]),
              std::bit_cast<std::uint64_t>(b.numbers[i]))
        << "number " << i;
  }
}

Rows alone(const Scene& scene, std::span<const ScheduledChange> changes, Summary& summary) {
  Rows rows;
  SimulationOptions options;
  options.changes = changes;
  options.on_sample = [&](const Sample& sample) { rows.add(sample); };
  summary = simulate(scene, options).summary;
  return rows;
}

void expect_each_as_alone(const Scene& scene, const std::vector<ScheduledChange>& changes) {
  Rows x;
  Rows y;
  AxesOptions options;
  options.changes = changes;
  options.on_tick = [&](const Tick& tick) {
    EXPECT_EQ(tick.axes[0].tick, tick.axes[1].tick);
    x.add(tick.axes[0]);
    y.add(tick.axes[1]);
  };
  const AxesResult both = simulate_axes(scene, options);
  std::vector<ScheduledChange> second_axis_changes;
  for (const ScheduledChange& change : changes)
    second_axis_changes.push_back({change.tick, axis_scene(change.scene, 1)});
  Summary first_axis_summary;
  Summary second_axis_summary;
  expect_same_bits(x, alone(scene, changes, first_axis_summary));
  expect_same_bits(y, alone(axis_scene(scene, 1), second_axis_changes, second_axis_summary));
  EXPECT_EQ(both.axes[0].summary.energy_scv_j, first_axis_summary.energy_scv_j);
  EXPECT_EQ(both.axes[1].summary.energy_scv_j, second_axis_summary.energy_scv_j);
  EXPECT_EQ(both.axes[1].summary.tail_peak_to_peak_m, second_axis_summary.tail_peak_to_peak_m);
  EXPECT_NE(both.axes[0].summary.peak_force_n, both.axes[1].summary.peak_force_n);
}

TEST(Corner, EachAxisIsBitForBitWhatItIsAlone) {
  for (std::size_t index = 0; index < algorithms().size(); ++index) {
    SCOPED_TRACE(algorithms()[index].name);
    Scene scene = corner_scene();
    scene.algorithm.index = index;
    expect_each_as_alone(scene, {});
  }
}

TEST(Corner, ChangesReachBothAxesAtTheirTick) {
  Scene changed = corner_scene();
  changed.algorithm.index = *find_algorithm("none");
  changed.axes[1].walls[0].stiffness_n_per_m = 100.0;
  changed.axes[1].device.mass_kg = 0.2;
  Scene again = changed;
  again.x().device.mass_kg = 0.06;
  expect_each_as_alone(corner_scene(), {{700, changed}, {1024, again}, {1500, corner_scene()}});
}

TEST(Corner, EndsWithTheAxisThatDiverges) {
  Scene scene = corner_scene();
  scene.algorithm.index = *find_algorithm("none");
  scene.axes[1].device.friction_n.reset();
  scene.axes[1].device.damping_n_s_per_m = 0.0;
  scene.axes[1].device.mass_kg = 1e-3;
  scene.axes[1].hand.reset();
  scene.axes[1].device.start_m = 0.9;
  scene.axes[1].walls = {{0.05, 1e6, 0.0}};
  std::uint64_t rows = 0;
  AxesOptions options;
  options.on_tick = [&](const Tick& /*tick*/) { ++rows; };
  const AxesResult both = simulate_axes(scene, options);
  ASSERT_EQ(both.axes[1].summary.verdict, Verdict::kDiverged);
  EXPECT_EQ(rows, both.axes[1].summary.ticks);
  EXPECT_LE(both.axes[0].summary.ticks, both.axes[1].summary.ticks + kAxesApartTicks);
  EXPECT_LT(both.axes[0].summary.ticks, scene.tick_count());
}

TEST(Corner, EveryPartOfASecondAxisIsValidated) {
  const auto key_of = [](const auto& spoil) {
    Scene scene = corner_scene();
    spoil(scene);
    const auto problem = validate(scene);
    return problem ? problem->key : std::string();
  };
  EXPECT_EQ(key_of([](Scene&) {}), "");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].device.mass_kg = -1.0; }), "device.y.mass_kg");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].device.encoder_m = 1e-15; }), "device.y.encoder_m");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].hand->path = {}; }), "hand.y.path");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].hand->grip_damping_n_s_per_m = 1.0; }),
            "hand.y.grip_damping_n_s_per_m");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].walls[1].damping_n_s_per_m = -1.0; }),
            "wall[2].damping_n_s_per_m");
  EXPECT_EQ(key_of([](Scene& s) { s.axes[1].walls.resize(kMaxWalls + 1); }), "wall");
}

}  // namespace
}  // namespace hapticwall
