#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/estimator/active_estimator.h"
#include "core/scene.h"
#include "core/scene_keys.h"
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

// Takes the mean of the second half, because a sliding mode swings about the velocity. Its
// positions stay for a tick, which costs up to λ0 T/2 = 0.0055 m/s.
TEST(EstimatorList, EveryEstimatorFollowsAConstantVelocity) {
  constexpr int kTicks = 2000;
  for (std::size_t i = 0; i < estimators().size(); ++i) {
    for (const double velocity_m_per_s : {0.0, 0.1, -0.1}) {
      ActiveEstimator estimator;
      estimator.configure(chosen(i), {});
      (void)estimator.velocity(0.0, 0.0);
      double sum_m_per_s = 0.0;
      for (int tick = 1; tick <= kTicks; ++tick) {
        const double displacement_m = velocity_m_per_s * 1e-3;
        const double now_m_per_s = estimator.velocity(tick * displacement_m, displacement_m);
        if (tick > kTicks / 2) sum_m_per_s += now_m_per_s;
      }
      const double error_m_per_s = estimators()[i].transfer != nullptr ? 1e-9 : 0.0055;
      EXPECT_NEAR(sum_m_per_s / (kTicks / 2), velocity_m_per_s, error_m_per_s)
          << estimators()[i].description.name;
    }
  }
}

// The limits of stability take the transfer function in the place of the estimator.
TEST(EstimatorList, TheTransferFunctionIsThatOfTheEstimator) {
  std::size_t linear = 0;
  for (std::size_t i = 0; i < estimators().size(); ++i) {
    EstimatorSettings settings;
    settings.index = i;
    const EstimatorContext context{2000.0, 0.0, &settings};
    const auto transfer = velocity_transfer(context);
    ASSERT_EQ(transfer.has_value(), estimators()[i].transfer != nullptr);
    if (!transfer) continue;
    ++linear;
    ActiveEstimator estimator;
    estimator.configure(chosen(i), context);
    std::vector<double> response;  // to a displacement of one metre, by division of the series
    double sum = 0.0;
    double moment = 0.0;
    for (std::size_t k = 0; k < 400; ++k) {
      double value = k < transfer->numerator_count ? transfer->numerator.at(k) : 0.0;
      for (std::size_t j = 1; j < transfer->denominator_count && j <= k; ++j)
        value -= transfer->denominator.at(j) * response[k - j];
      response.push_back(value);
      sum += value;
      moment += static_cast<double>(k) * value;
      EXPECT_NEAR(estimator.velocity(0.0, k == 0 ? 1.0 : 0.0), 2000.0 * value, 1e-9)
          << estimators()[i].description.name << ", tick " << k;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9) << estimators()[i].description.name;
    EXPECT_NEAR(transfer->delay_ticks(), 0.5 + moment, 1e-9) << estimators()[i].description.name;
  }
  EXPECT_GE(linear, 4U);
}

TEST(EstimatorList, ASceneTakesEveryKeyWithinItsRangeOnly) {
  for (const ParameterDescription& parameter : estimator_parameters()) {
    Scene scene;
    const std::string path = "estimator." + std::string(parameter.key);
    const auto number = find_scene_number(scene, path);
    ASSERT_TRUE(number) << path;
    for (const double value : {parameter.minimum, parameter.maximum}) {
      number->set(scene, value);
      EXPECT_FALSE(validate(scene)) << path << " = " << value;
    }
    for (const double value :
         {parameter.minimum * 0.99, parameter.maximum * 1.01, std::nan(""), HUGE_VAL}) {
      number->set(scene, value);
      const auto problem = validate(scene);
      ASSERT_TRUE(problem) << path << " = " << value;
      EXPECT_EQ(problem->key, path);
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
