#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

#include "core/estimator/active_estimator.h"
#include "core/scene.h"
#include "core/tick/servo_step.h"

namespace hapticwall {
namespace {

const Estimator* chosen(std::size_t index) {
  EstimatorSettings settings;
  settings.index = index;
  return chosen_estimator(settings);
}

TEST(EstimatorList, EveryNameIsItsOwnAndFoundAgain) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < estimators().size(); ++i) {
    const EstimatorDescription& estimator = estimators()[i].description;
    EXPECT_TRUE(names.insert(estimator.name).second) << estimator.name;
    EXPECT_EQ(find_estimator(estimator.name), i);
    EXPECT_FALSE(estimator.title.empty() || estimator.idea.empty() || estimator.equation.empty());
    for (const ParameterDescription& parameter : estimator.parameters)
      EXPECT_FALSE(parameter.meaning.empty() || parameter.default_text.empty()) << parameter.key;
  }
  EXPECT_EQ(find_estimator("no-such-thing"), std::nullopt);
  EXPECT_EQ(find_estimator(""), std::nullopt);
}

TEST(EstimatorList, TheDefaultIsTheInlineBackwardDifference) {
  EXPECT_EQ(find_estimator("backward-difference"), EstimatorSettings{}.index);
  EXPECT_EQ(servo_settings(Scene{}).estimator, nullptr);
  for (std::size_t i = 1; i < estimators().size(); ++i) EXPECT_EQ(chosen(i), &estimators()[i]);
}

TEST(EstimatorList, ASceneTakesNoIndexOutsideIt) {
  Scene scene;
  EXPECT_FALSE(validate(scene));
  scene.estimator.index = estimators().size();
  const auto problem = validate(scene);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->key, "estimator.name");
}

TEST(EstimatorList, EveryEstimatorFollowsAConstantVelocity) {
  for (std::size_t i = 0; i < estimators().size(); ++i) {
    for (const double velocity_m_per_s : {0.0, 0.1, -0.1}) {
      ActiveEstimator estimator;
      estimator.configure(chosen(i), {});
      double estimate_m_per_s = estimator.velocity(0.0, 0.0);
      for (int tick = 1; tick <= 2000; ++tick) {
        const double displacement_m = velocity_m_per_s * 1e-3;
        estimate_m_per_s = estimator.velocity(tick * displacement_m, displacement_m);
      }
      EXPECT_NEAR(estimate_m_per_s, velocity_m_per_s, 1e-3) << estimators()[i].description.name;
    }
  }
}

TEST(EstimatorList, AfterAResetEveryEstimatorIsAsNew) {
  for (std::size_t i = 0; i < estimators().size(); ++i) {
    ActiveEstimator used;
    used.configure(chosen(i), {});
    for (int tick = 0; tick < 50; ++tick) (void)used.velocity(1e-3 * tick, 1e-3);
    used.reset();
    ActiveEstimator fresh;
    fresh.configure(chosen(i), {});
    double position_m = 0.01;
    for (const double displacement_m : {0.0, 1e-4, 3e-4, -2e-4, 0.0}) {
      position_m += displacement_m;
      const double estimate_m_per_s = used.velocity(position_m, displacement_m);
      EXPECT_EQ(estimate_m_per_s, fresh.velocity(position_m, displacement_m)) << i;
      EXPECT_TRUE(std::isfinite(estimate_m_per_s)) << i;
    }
  }
}

// Two estimators may share a key.
TEST(DescriptionUnion, HasEachNameOnceInTheOrderOfTheLists) {
  constexpr std::array kFirst{number_parameter("a", "", 0.0, 1.0, "0", "first"),
                              switch_parameter("b", "second")};
  constexpr std::array kOther{number_parameter("c", "", 0.0, 1.0, "0", "third"),
                              number_parameter("a", "", 0.0, 1.0, "0", "first")};
  DescriptionUnion<ParameterDescription, 3> all;
  all.add(kFirst, &ParameterDescription::key);
  all.add(kOther, &ParameterDescription::key);
  ASSERT_EQ(all.in_use().size(), 3U);
  EXPECT_EQ(all.in_use()[0].key, "a");
  EXPECT_EQ(all.in_use()[1].key, "b");
  EXPECT_EQ(all.in_use()[2].key, "c");
}

}  // namespace
}  // namespace hapticwall
