#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "tests/position_bench.h"

namespace hapticwall {
namespace {

TEST(AlgorithmList, EveryNameIsItsOwnAndFoundAgain) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    const AlgorithmDescription& algorithm = algorithms()[i];
    EXPECT_TRUE(names.insert(algorithm.name).second) << algorithm.name;
    EXPECT_EQ(find_algorithm(algorithm.name), i);
    if (!algorithm.old_name.empty()) {
      EXPECT_TRUE(names.insert(algorithm.old_name).second) << algorithm.old_name;
      EXPECT_EQ(find_algorithm(algorithm.old_name), i);
    }
    EXPECT_FALSE(algorithm.title.empty());
    EXPECT_FALSE(algorithm.idea.empty());
  }
  EXPECT_EQ(find_algorithm("no-such-thing"), std::nullopt);
  EXPECT_EQ(find_algorithm(""), std::nullopt);
}

TEST(AlgorithmList, AComparisonShowsEachFormUnlessTheSceneChoosesOne) {
  AlgorithmSettings settings;
  const std::size_t control = *find_algorithm("passivity-control");
  const std::vector<std::size_t> indices{control, 0};
  const std::size_t observer = *find_algorithm_parameter("observer");
  const auto rows = compared_algorithms(settings, indices);
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].settings.index, control);
    EXPECT_EQ(rows[i].settings.values.at(observer), static_cast<double>(i));
  }
  EXPECT_EQ(rows[1].label, "passivity-control (held-force)");
  EXPECT_EQ(rows[3].label, "none");
  EXPECT_EQ(rows[3].settings, settings);
  settings.values.at(observer) = 2.0;
  const auto chosen = compared_algorithms(settings, indices);
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen[0].label, "passivity-control (one-step)");
}

TEST(AlgorithmList, AnIndexOutsideItIsTheFirstAlgorithm) {
  ActiveAlgorithm algorithm;
  algorithm.configure(algorithms().size(), {.walls = {}, .settings = nullptr});
  EXPECT_EQ(algorithm.algorithm(), 0U);
}

TEST(AlgorithmList, EveryParameterIsInTheUnionOnce) {
  std::set<std::string_view> keys;
  for (const ParameterDescription& parameter : algorithm_parameters()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.key;
    EXPECT_FALSE(parameter.default_text.empty()) << parameter.key;
  }
  for (const AlgorithmDescription& algorithm : algorithms()) {
    for (const ParameterDescription& parameter : algorithm.parameters) {
      EXPECT_TRUE(keys.contains(parameter.key)) << parameter.key;
    }
  }
}

// 1 N held through -0.25 mm at exactly 0.25 m/s.
TEST(PassivityControl, ActsAboveItsVelocityFloorOnly) {
  AlgorithmSettings settings;
  testing::set_parameter(settings, "observer", 1.0);
  testing::set_parameter(settings, "max_damping_n_s_per_m", 1e3);
  for (const double floor : {0.25, std::nextafter(0.25, 0.0)}) {
    testing::set_parameter(settings, "velocity_floor_m_per_s", floor);
    AlgorithmContext context;
    context.settings = &settings;
    ActiveAlgorithm control;
    control.configure(find_algorithm("passivity-control").value(), context);
    const double force_n = control.step({0.5, 1e-4, -0.25e-3, -0.25, 1e-4, 1.0, true});
    EXPECT_EQ(force_n != 0.5, floor < 0.25);
  }
}

}  // namespace
}  // namespace hapticwall
