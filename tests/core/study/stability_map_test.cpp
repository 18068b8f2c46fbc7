#include "core/study/stability_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "core/study/bound_lines.h"
#include "tests/core/study/study_scenes.h"

namespace hapticwall {
namespace {

MapAxis axis(const Scene& scene, const char* path, double low, double high, std::size_t count,
             bool logarithmic = false) {
  return {find_scene_number(scene, path).value(), low, high, count, logarithmic};
}

StabilityMap small_map() {
  StabilityMap map;
  map.scene = testing::pressed_wall(1000.0);
  map.scene.duration_s = 1.5;
  map.scene.x().device.friction_n = 0.05;
  map.algorithms = {find_algorithm("none").value(), find_algorithm("energy-bounding").value()};
  map.x = axis(map.scene, "wall.stiffness_n_per_m", 500.0, 5000.0, 5, true);
  map.y = axis(map.scene, "wall.damping_n_s_per_m", 0.0, 2.0, 3);
  return map;
}

TEST(MapAxisValues, KeepBothEndsAndHaveEqualStepsOrRatios) {
  const Scene scene = testing::pressed_wall(1000.0);
  const MapAxis linear = axis(scene, "wall.damping_n_s_per_m", 0.1, 0.7, 7);
  EXPECT_EQ(linear.value(0), 0.1);
  EXPECT_EQ(linear.value(6), 0.7);
  EXPECT_NEAR(linear.value(3), 0.4, 1e-15);
  const MapAxis ratios = axis(scene, "wall.stiffness_n_per_m", 1.0, 1e6, 7, true);
  EXPECT_EQ(ratios.value(0), 1.0);
  EXPECT_EQ(ratios.value(6), 1e6);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_NEAR(ratios.value(i) / ratios.value(i - 1), 10, 1e-9);
}

TEST(MapAxisValues, OfAWholeKeyAreTheWholeNumbersOfItsSteps) {
  const Scene scene = testing::pressed_wall(1000.0);
  for (const std::size_t high : {42U, 46U, 1000U}) {
    const MapAxis delay =
        axis(scene, "device.delay_ticks", 0.0, static_cast<double>(high), high + 1);
    for (std::size_t i = 0; i <= high; ++i) EXPECT_EQ(delay.value(i), static_cast<double>(i));
  }
  const MapAxis powers = axis(scene, "device.delay_ticks", 1.0, 512.0, 10, true);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(powers.value(i), std::ldexp(1.0, static_cast<int>(i)));
  EXPECT_EQ(axis(scene, "device.delay_ticks", 0.0, 1.0, 3).value(1), 0.5);
}

TEST(StabilityMaps, CellsAreTheSceneWithBothValuesAndTheAlgorithm) {
  const StabilityMap map = small_map();
  ASSERT_EQ(map.cell_count(), 30U);
  const std::size_t cell = 1 * 15 + 2 * 5 + 3;
  const MapPlace place = map.place(cell);
  EXPECT_EQ(place.algorithm, 1U);
  EXPECT_EQ(place.y, 2U);
  EXPECT_EQ(place.x, 3U);
  const Scene scene = map.scene_at(cell);
  EXPECT_EQ(scene.algorithm.index, find_algorithm("energy-bounding").value());
  EXPECT_EQ(scene.x().walls[0].damping_n_s_per_m, 2.0);
  EXPECT_NEAR(scene.x().walls[0].stiffness_n_per_m, 500.0 * std::pow(10.0, 0.75), 1e-9);
}

TEST(StabilityMaps, EveryCellIsThatSceneSimulatedByItselfWhateverTheParts) {
  const StabilityMap map = small_map();
  std::vector<MapMetrics> parts;
  for (std::size_t begin = 0; begin < 30; begin += 7) {
    const auto part = run_cells(map, begin, std::min<std::size_t>(begin + 7, 30));
    parts.insert(parts.end(), part.begin(), part.end());
  }
  ASSERT_EQ(parts.size(), 30U);
  EXPECT_EQ(parts, run_cells(map, 0, 30));
  bool any_settled = false;
  bool any_oscillating = false;
  for (std::size_t cell = 0; cell < parts.size(); ++cell) {
    EXPECT_EQ(parts[cell], map_metrics(simulate(map.scene_at(cell)).summary)) << cell;
    any_settled = any_settled || parts[cell].verdict == Verdict::kSettled;
    any_oscillating = any_oscillating || parts[cell].verdict == Verdict::kOscillating;
  }
  EXPECT_TRUE(any_settled);
  EXPECT_TRUE(any_oscillating);
}

TEST(StabilityMaps, AStoppedPartHasNoCells) {
  EXPECT_TRUE(run_cells(small_map(), 0, 30, [] { return true; }).empty());
}

TEST(StabilityMaps, AnInvalidCellIsNamedBeforeAnythingRuns) {
  StabilityMap map = small_map();
  EXPECT_FALSE(validate(map));
  map.y.low = -1.0;
  const auto problem = validate(map);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, "wall.damping_n_s_per_m");
}

TEST(StabilityMaps, AnAxisHasTwoValuesOrMore) {
  for (const std::size_t count : {0U, 1U}) {
    for (MapAxis StabilityMap::*const short_one : {&StabilityMap::x, &StabilityMap::y}) {
      StabilityMap map = small_map();
      (map.*short_one).count = count;
      const auto problem = validate(map);
      ASSERT_TRUE(problem) << count;
      EXPECT_EQ(problem->key, (map.*short_one).number.path);
      EXPECT_EQ(problem->message, "an axis takes two values or more");
    }
  }
}

TEST(DimensionlessAxes, AreWhatTheFieldsLiteratureHas) {
  Scene scene = testing::pressed_wall(2000.0);  // 0.05 kg, 1 kHz
  scene.x().device.encoder_m = 1e-4;
  const MapAxis stiffness = axis(scene, "wall.stiffness_n_per_m", 1.0, 2.0, 2);
  const MapAxis damping = axis(scene, "device.damping_n_s_per_m", 1.0, 2.0, 2);
  const MapAxis friction = axis(scene, "device.friction_n", 1.0, 2.0, 2);
  const MapAxis rate = axis(scene, "sampling.rate_hz", 1.0, 2.0, 2);
  EXPECT_EQ(dimensionless(scene, stiffness, damping)->symbol, "K T²/m");
  EXPECT_DOUBLE_EQ(dimensionless(scene, stiffness, damping)->factor, 1e-6 / 0.05);
  EXPECT_DOUBLE_EQ(dimensionless(scene, damping, stiffness)->factor, 1e-3 / 0.05);
  EXPECT_DOUBLE_EQ(dimensionless(scene, friction, damping)->factor, 1.0 / 0.2);
  EXPECT_FALSE(dimensionless(scene, stiffness, rate)) << "T is no constant of this map";
  EXPECT_FALSE(dimensionless(scene, friction, stiffness)) << "nor is K of this one";
  EXPECT_FALSE(dimensionless(scene, rate, damping));
  scene.x().device.encoder_m.reset();
  EXPECT_FALSE(dimensionless(scene, friction, damping));
}

TEST(BoundLines, StandWhereTheWallIsAsStiffAsTheBound) {
  StabilityMap map = small_map();  // b = 1, T = 1 ms: K = 2000 (1 - B)
  map.x = axis(map.scene, "wall.stiffness_n_per_m", 500.0, 2500.0, 401);
  map.y = axis(map.scene, "wall.damping_n_s_per_m", 0.0, 0.5, 11);
  const auto lines = bound_lines(map, cell_bounds(map), &StabilityBounds::passive_n_per_m);
  ASSERT_FALSE(lines.empty());
  double lowest = std::numeric_limits<double>::infinity();
  double highest = 0.0;
  for (const BoundSegment& line : lines) {
    for (const MapPoint& point : {line.from, line.to}) {
      const double stiffness = 500.0 + 5.0 * point.x;
      const double damping = 0.05 * point.y;
      EXPECT_NEAR(stiffness, 2000.0 * (1.0 - damping), 1e-9);
      lowest = std::min(lowest, point.y);
      highest = std::max(highest, point.y);
    }
  }
  EXPECT_EQ(lowest, 0.0);
  EXPECT_EQ(highest, 10.0);
  // No encoder: what is made of its count does not apply.
  EXPECT_TRUE(bound_lines(map, cell_bounds(map), &StabilityBounds::friction_n_per_m).empty());
  map.scene.x().walls.clear();
  map.x = axis(map.scene, "device.mass_kg", 0.01, 0.1, 3);
  map.y = axis(map.scene, "device.damping_n_s_per_m", 0.0, 0.5, 3);
  EXPECT_TRUE(bound_lines(map, cell_bounds(map), &StabilityBounds::passive_n_per_m).empty());
}

// The lines enclose the area where both numbers of the wall are allowed: no line goes on beyond the
// other limit.
TEST(Chai3dLines, EncloseWhatIsAllowed) {
  StabilityMap map = small_map();
  map.x = axis(map.scene, "wall.stiffness_n_per_m", 500.0, 2500.0, 401);
  map.y = axis(map.scene, "wall.damping_n_s_per_m", 0.0, 0.5, 11);
  const auto lines = [&] { return chai3d_lines(map, cell_bounds(map)); };
  EXPECT_TRUE(lines().empty());
  map.scene.x().device.chai3d_stiffness_n_per_m = 803.0;
  EXPECT_TRUE(lines().empty()) << "one number alone";
  map.scene.x().device.chai3d_damping_n_s_per_m = 0.12;
  std::size_t stiffest = 0;
  for (const BoundSegment& line : lines()) {
    for (const MapPoint& point : {line.from, line.to}) {
      const double stiffness = 500.0 + 5.0 * point.x;
      const double damping = 0.05 * point.y;
      EXPECT_LE(stiffness, 803.0 + 1e-9);
      EXPECT_LE(damping, 0.12 + 1e-9);
      EXPECT_NEAR(std::max(stiffness / 803.0, damping / 0.12), 1.0, 1e-9);
      if (std::abs(stiffness - 803.0) < 1e-9) ++stiffest;
    }
  }
  EXPECT_EQ(stiffest, 2U * 2U) << "from 0 to 0.1 N s/m";
  EXPECT_EQ(lines().size(), 2U + 60U) << "and from 500 to 800 N/m";
  map.y = axis(map.scene, "device.damping_n_s_per_m", 0.1, 1.0, 11);
  map.scene.x().walls.front().damping_n_s_per_m = 0.12;
  EXPECT_EQ(lines().size(), 10U) << "as damped as it may be";
  map.scene.x().walls.front().damping_n_s_per_m = 0.13;
  EXPECT_TRUE(lines().empty()) << "no stiffness is allowed";
  map.scene.x().walls.front().damping_n_s_per_m = 0.0;
  map.scene.x().device.chai3d_stiffness_n_per_m = 3000.0;
  EXPECT_TRUE(lines().empty()) << "beyond the axis";
}

// K = 2 b f on two logarithmic axes is a straight line, and exact however few the values are.
TEST(BoundLines, AreExactOnLogarithmicAxes) {
  StabilityMap map = small_map();
  map.x = axis(map.scene, "wall.stiffness_n_per_m", 300.0, 1e5, 4, true);
  map.y = axis(map.scene, "sampling.rate_hz", 500.0, 8000.0, 3, true);
  const auto lines = bound_lines(map, cell_bounds(map), &StabilityBounds::passive_n_per_m);
  ASSERT_FALSE(lines.empty());
  for (const BoundSegment& line : lines) {
    for (const MapPoint& point : {line.from, line.to}) {
      const double stiffness = 300.0 * std::pow(1e5 / 300.0, point.x / 3.0);
      const double rate_hz = 500.0 * std::pow(16.0, point.y / 2.0);
      EXPECT_NEAR(stiffness, 2.0 * rate_hz, 1e-9 * stiffness);
    }
  }
}

}  // namespace
}  // namespace hapticwall
