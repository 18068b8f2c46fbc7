#include "app/ui/computed/map_choice.h"

#include <gtest/gtest.h>

#include "app/file/scene/scene_file.h"

namespace hapticwall::test {
namespace {

using ui::MapAxisChoice;
using ui::MapChoice;

Scene scene_called(const char* name) { return file::load_scene(name)->scene; }

MapAxis around(const char* path, std::optional<double> value) {
  return ui::axis_around(find_scene_number(scene_called("press"), path).value(), value);
}

TEST(MapAxisAround, ShowsADecadeOnEitherSideOfAPositiveValue) {
  const MapAxis axis = around("wall.stiffness_n_per_m", 35000.0);
  EXPECT_DOUBLE_EQ(axis.low, 3500.0);
  EXPECT_DOUBLE_EQ(axis.high, 350000.0);
  EXPECT_TRUE(axis.logarithmic);
  EXPECT_EQ(axis.count, ui::kLiveMapValues);
}

TEST(MapAxisAround, StaysWithinTheRangeOfTheNumber) {
  EXPECT_EQ(around("device.encoder_m", 0.005).high, 0.01);
  EXPECT_EQ(around("wall.position_m", 0.99).high, 1.0);
}

TEST(MapAxisAround, IsLinearWhereThereIsNoRatio) {
  for (const std::optional<double> none : {std::optional(0.0), std::optional<double>()}) {
    const MapAxis axis = around("wall.damping_n_s_per_m", none);
    EXPECT_FALSE(axis.logarithmic);
    EXPECT_EQ(axis.low, 0.0);
    EXPECT_GT(axis.high, 1.0);
  }
  const MapAxis position = around("wall.position_m", 0.05);
  EXPECT_FALSE(position.logarithmic);
  EXPECT_LT(position.low, 0.05);
  EXPECT_GT(position.high, 0.05);
}

TEST(MapAxisAround, HasEachWholeNumberOnce) {
  const MapAxis axis = around("device.delay_ticks", std::nullopt);
  for (std::size_t i = 0; i < axis.count; ++i)
    EXPECT_EQ(axis.value(i), static_cast<double>(i)) << i;
  EXPECT_EQ(axis.count, 11U);
}

TEST(MapAxisAround, EveryNumberOfEverySceneHasAValidMap) {
  for (const file::BuiltinScene& builtin : file::builtin_scenes()) {
    const Scene scene = scene_called(std::string(builtin.name).c_str());
    for (const SceneNumber& number : ui::map_numbers(scene)) {
      MapChoice choice;
      choice.axes.front().path = number.path;
      const StabilityMap map = ui::map_of(choice, scene);
      EXPECT_LT(map.x.low, map.x.high) << number.path;
      EXPECT_NE(map.x.number.path, map.y.number.path);
      EXPECT_TRUE(map.x.number.range.contains(map.x.low)) << number.path;
      EXPECT_TRUE(map.x.number.range.contains(map.x.high)) << number.path;
    }
  }
}

class MapOf : public ::testing::Test {
 protected:
  Scene scene = scene_called("press");
  MapChoice choice;
};

TEST_F(MapOf, IsThatOfStiffnessAndDampingUnderTheAlgorithmInForceAtFirst) {
  const StabilityMap map = ui::map_of(choice, scene);
  EXPECT_EQ(map.x.number.path, "wall.stiffness_n_per_m");
  EXPECT_EQ(map.y.number.path, "device.damping_n_s_per_m");
  EXPECT_EQ(map.algorithms, std::vector{scene.algorithm.index});
}

TEST_F(MapOf, StaysWhileTheNumbersOfItsAxesMoveWithinIt) {
  const StabilityMap before = ui::map_of(choice, scene);
  scene.x().walls.front().stiffness_n_per_m = 50000.0;
  scene.x().device.damping_n_s_per_m = 2.0;
  EXPECT_TRUE(ui::same_cells(before, ui::map_of(choice, scene)));
  scene.x().device.mass_kg = 0.06;
  EXPECT_FALSE(ui::same_cells(before, ui::map_of(choice, scene)));
}

TEST_F(MapOf, FollowsAValueThatLeavesItUnlessItsRangeWasTyped) {
  static_cast<void>(ui::map_of(choice, scene));
  scene.x().walls.front().stiffness_n_per_m = 1e6;
  EXPECT_EQ(ui::map_of(choice, scene).x.low, 1e5);
  ASSERT_FALSE(ui::set_range(choice.axes.front(), 1e3, 1e4, true));
  EXPECT_EQ(ui::map_of(choice, scene).x.high, 1e4);
}

TEST_F(MapOf, TakesTheUsualNumbersWhereTheSceneHasNotTheChosenOnes) {
  static_cast<void>(ui::map_of(choice, scene));
  const StabilityMap map = ui::map_of(choice, scene_called("layers"));
  EXPECT_NE(map.x.number.path, map.y.number.path);
  EXPECT_FALSE(validate(map));
}

TEST_F(MapOf, RefusesARangeThatIsNone) {
  static_cast<void>(ui::map_of(choice, scene));
  MapAxisChoice& x = choice.axes.front();
  const MapAxis before = *x.range;
  EXPECT_TRUE(ui::set_range(x, 5.0, 5.0, false));
  EXPECT_TRUE(ui::set_range(x, 0.0, 5.0, true));
  EXPECT_TRUE(ui::set_range(x, -1.0, 5.0, false));
  EXPECT_TRUE(ui::set_range(x, 1.0, 1e12, false));
  EXPECT_EQ(x.range->low, before.low);
  EXPECT_FALSE(x.typed);
  ui::choose_number(x, "device.delay_ticks");
  static_cast<void>(ui::map_of(choice, scene));
  EXPECT_TRUE(ui::set_range(x, 0.5, 4.0, false));
  EXPECT_TRUE(ui::set_range(x, 0.0, 100.0, false)) << "more values than a map has";
  EXPECT_FALSE(ui::set_range(x, 0.0, 4.0, false));
  EXPECT_EQ(x.range->count, 5U);
}

TEST_F(MapOf, HasTheChosenAlgorithmsInTheirOrder) {
  ui::choose_algorithm_in_map(choice, 2, true);
  ui::choose_algorithm_in_map(choice, 0, true);
  ui::choose_algorithm_in_map(choice, 2, true);
  EXPECT_EQ(ui::map_of(choice, scene).algorithms, (std::vector<std::size_t>{0, 2}));
  ui::choose_algorithm_in_map(choice, 0, false);
  EXPECT_EQ(ui::map_of(choice, scene).algorithms, std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace hapticwall::test
