// The figures of the literature against closed forms.
#include "core/study/contact_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/core/study/study_scenes.h"

namespace hapticwall {
namespace {

std::size_t index_of(const char* name) { return find_algorithm(name).value(); }

constexpr double kStudyPeriodS = 1e-3;

// ---- a handle that goes into a wall at constant speed, whatever pushes it back ----

constexpr double kSpeedMPerS = 0.1;
constexpr double kFirmNPerM = 1e8;
constexpr double kDepthM = 0.0149;

// The hand is 1e8 N/m stiff: against 35 kN/m the handle is late by 1 part in 3000. The wall is met
// between two ticks.
Scene steady_entry(double wall_n_per_m) {
  Scene scene;
  scene.name = "steady";
  scene.duration_s = 3.0;
  scene.x().device.mass_kg = 0.05;
  scene.x().device.damping_n_s_per_m = 1.0;
  scene.x().device.start_m = 0.03;
  scene.x().hand = HandSettings{};
  scene.x().hand->stiffness_n_per_m = kFirmNPerM;
  scene.x().hand->damping_n_s_per_m = 5000.0;
  const double end_m = 0.05 + kDepthM;
  scene.x().hand->path = {{0.0, 0.03}, {(end_m - 0.03) / kSpeedMPerS, end_m}};
  scene.x().walls = {{0.05003, wall_n_per_m, 0.0}};
  return scene;
}

ContactStudyPlan plan_of(Scene scene, const std::vector<const char*>& names) {
  ContactStudyPlan plan;
  plan.scene = std::move(scene);
  for (const char* name : names) plan.algorithms.push_back(index_of(name));
  plan.count = 2;
  return plan;
}

ContactMetrics figures_of(Scene scene, const char* algorithm) {
  const ContactStudyPlan plan = plan_of(std::move(scene), {algorithm});
  EXPECT_FALSE(validate(plan));
  const auto rows = study_contact(plan);
  EXPECT_EQ(rows.size(), 1U);
  return rows.at(0);
}

TEST(RateHardness, OfASpringWallIsItsStiffness) {
  for (const double stiffness : {500.0, 3000.0, 35000.0}) {
    const ContactMetrics figures = figures_of(steady_entry(stiffness), "none");
    EXPECT_NEAR(figures.approach_speed_m_per_s.value(), kSpeedMPerS, 1e-4 * kSpeedMPerS);
    EXPECT_NEAR(figures.rate_hardness_n_per_m.value(), stiffness, 1e-3 * stiffness);
  }
}

TEST(RateHardness, WithAnEncoderIsTheStiffnessUpToATick) {
  Scene scene = steady_entry(3000.0);
  scene.x().device.encoder_m = 0.254e-3;  // 2.54 ticks a count: steps of 2 and 3
  const double rate_hardness = figures_of(scene, "none").rate_hardness_n_per_m.value();
  EXPECT_GE(rate_hardness, 0.999 * 3000.0);
  EXPECT_LE(rate_hardness, 1.001 * 3000.0 * 2.54 / 2.0);
}

TEST(RateHardness, OfAVirtualCouplingIsThatOfTwoSprings) {
  const double coupling = 2000.0;  // 2b/T
  const double expected = 35000.0 * coupling / (35000.0 + coupling);
  EXPECT_NEAR(figures_of(steady_entry(35000.0), "virtual-coupling").rate_hardness_n_per_m.value(),
              expected, 1e-3 * expected);
}

TEST(RateHardness, OfEnergyBoundingIsTheDampingOverTheTickWhateverTheWall) {
  for (const double stiffness : {5000.0, 35000.0}) {
    EXPECT_NEAR(
        figures_of(steady_entry(stiffness), "energy-bounding").rate_hardness_n_per_m.value(),
        1000.0, 1.0);
  }
  Scene faster = steady_entry(35000.0);
  faster.sampling.rate_hz = 4000.0;
  EXPECT_NEAR(figures_of(faster, "energy-bounding").rate_hardness_n_per_m.value(), 4000.0, 4.0);
}

TEST(RiseTime, OfASpringWallIsEightTenthsOfTheWay) {
  const ContactMetrics figures = figures_of(steady_entry(1000.0), "none");
  ASSERT_EQ(figures.summary.verdict, Verdict::kSettled);
  const double depth_m = 0.05 + kDepthM - 0.05003;
  EXPECT_NEAR(figures.rise_time_s.value(), 0.8 * depth_m / kSpeedMPerS, kStudyPeriodS);
  EXPECT_NEAR(figures.peak_penetration_m.value(), depth_m, 1e-4 * depth_m);
}

TEST(PeakPenetration, IsTrueAndNotMeasured) {
  Scene scene = steady_entry(1000.0);
  scene.x().device.encoder_m = 1e-3;
  const ContactMetrics figures = figures_of(scene, "none");
  EXPECT_NEAR(figures.peak_penetration_m.value(), 0.05 + kDepthM - 0.05003, 1e-5);
  EXPECT_GT(std::abs(figures.summary.max_penetration_m.value() - *figures.peak_penetration_m),
            5e-5);
}

TEST(ContactStudy, OfAWallThatIsNeverTouchedIsEmpty) {
  Scene scene = steady_entry(1000.0);
  scene.x().walls[0].position_m = 0.2;
  const ContactMetrics figures = figures_of(scene, "none");
  EXPECT_EQ(figures.summary.verdict, Verdict::kNoContact);
  EXPECT_FALSE(figures.limits.failed.first);
  EXPECT_FALSE(figures.stiffest());
  EXPECT_FALSE(figures.approach_speed_m_per_s);
  EXPECT_FALSE(figures.rate_hardness_n_per_m);
  EXPECT_FALSE(figures.rise_time_s);
  EXPECT_FALSE(figures.peak_penetration_m);
  EXPECT_EQ(figures.energy_to_hand_j, 0.0);
}

// ---- the stiffest wall ----

ContactStudyPlan pressed(double low, double high, std::size_t count) {
  Scene scene = testing::pressed_wall(1000.0);
  scene.duration_s = 30.0;  // so that a barely stable wall comes to rest
  ContactStudyPlan plan = plan_of(scene, {"none"});
  plan.low_n_per_m = low;
  plan.high_n_per_m = high;
  plan.count = count;
  return plan;
}

TEST(Stiffest, OfABareWallIsTwiceTheDampingOverTheTick) {
  const ContactMetrics found = study_contact(pressed(500.0, 8000.0, 9)).at(0);
  const double displayed = found.stiffest()->displayed_stiffness_n_per_m.value();
  EXPECT_NEAR(displayed, 2000.0, 40.0);
  EXPECT_LT(displayed, found.limits.failed.first.value());
  EXPECT_GT(displayed, 0.998 * *found.limits.failed.first);
  EXPECT_EQ(found.limits.changes, 1U);
}

TEST(Stiffest, IsAtTheEndOfTheScanIfAllWallsSettle) {
  ContactStudyPlan plan = pressed(500.0, 1500.0, 3);
  plan.algorithms.push_back(index_of("virtual-coupling"));
  const auto rows = study_contact(plan);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_FALSE(rows[0].limits.failed.first);
  EXPECT_EQ(rows[0].limits.settled.last, 1500.0);
  EXPECT_NEAR(rows[1].stiffest()->displayed_stiffness_n_per_m.value(), 1500.0 * 2000.0 / 3500.0,
              1e-3);
}

TEST(Stiffest, IsNotThereIfTheSoftestWallFails) {
  const ContactMetrics nowhere = study_contact(pressed(5000.0, 8000.0, 4)).at(0);
  EXPECT_FALSE(nowhere.stiffest());
  EXPECT_FALSE(nowhere.limits.settled.last);
}

// ---- the built-in tap and press, as far as these figures go ----

Scene paper_scene(HandSettings hand) {
  Scene scene;
  scene.x().device.friction_n = 0.14;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.force_limit_n = 8.9;
  scene.x().hand = std::move(hand);
  scene.x().walls = {{0.05, 35000.0, 0.0}};
  scene.algorithm.values.at(find_algorithm_parameter("rest_force_step_n").value()) = 0.01;
  return scene;
}

HandSettings tap() {
  return {0.2, 300.0, 5.0, 2000.0, 2.0, {{0.0, 0.03}, {0.1765, 0.0653}}, false};
}
HandSettings press() { return {0.4, 250.0, 33.0, 1000.0, 1.0, {{0.0, 0.03}, {1.5, 0.075}}, false}; }

TEST(Stiffest, IsNotOfAnIslandAboveTheFirstFailure) {
  ContactStudyPlan plan = plan_of(paper_scene(press()), {"none"});
  plan.low_n_per_m = 1000.0;
  plan.high_n_per_m = 1e5;
  plan.count = 200;
  const ContactMetrics found = study_contact(plan).at(0);
  EXPECT_GT(found.limits.changes, 1U);
  EXPECT_LT(found.stiffest()->displayed_stiffness_n_per_m.value(), *found.limits.failed.first);
  EXPECT_GT(found.limits.settled.last.value(), 2.0 * *found.limits.failed.first);
  // The softest wall between two islands: there is nothing below the first failure.
  plan.low_n_per_m = 1.001 * *found.limits.failed.first;
  plan.count = 2;
  EXPECT_FALSE(study_contact(plan).at(0).stiffest());
}

TEST(EnergyToTheHand, IsWhatATapUnderEnergyBoundingGives) {
  const ContactMetrics active = figures_of(paper_scene(tap()), "energy-bounding");
  EXPECT_NEAR(active.energy_to_hand_j, 2.88, 0.005);
  EXPECT_EQ(active.energy_to_hand_j, -active.summary.passivity_margin_j.value());
  EXPECT_EQ(active.summary.verdict, Verdict::kOscillating);
  EXPECT_FALSE(active.rise_time_s) << "it never comes to a force";
  EXPECT_EQ(figures_of(paper_scene(press()), "energy-bounding").energy_to_hand_j, 0.0);
}

// ---- the plan ----

TEST(ContactStudy, OfACornerIsThatOfAxisX) {
  Scene corner = steady_entry(3000.0);
  const ContactMetrics alone = figures_of(corner, "none");
  corner.axes.push_back({corner.x().device, corner.x().hand, {{0.04, 500.0, 0.0}}});
  const ContactMetrics with_y = figures_of(corner, "none");
  EXPECT_EQ(with_y.rate_hardness_n_per_m, alone.rate_hardness_n_per_m);
  EXPECT_EQ(with_y.peak_penetration_m, alone.peak_penetration_m);
  EXPECT_EQ(with_y.stiffest()->displayed_stiffness_n_per_m,
            alone.stiffest()->displayed_stiffness_n_per_m);
}

TEST(ContactStudy, IsRefusedWithoutAWallAndWithAnInvalidOne) {
  Scene scene = steady_entry(1000.0);
  scene.x().walls.clear();
  const auto none = validate(plan_of(scene, {"none"}));
  ASSERT_TRUE(none);
  EXPECT_EQ(none->key, "wall");
  ContactStudyPlan plan = plan_of(steady_entry(1000.0), {"none"});
  plan.high_n_per_m = 1e10;
  const auto invalid = validate(plan);
  ASSERT_TRUE(invalid);
  EXPECT_NE(invalid->key.find("stiffness_n_per_m"), std::string::npos);
}

TEST(ContactStudy, TellsProgressAndStops) {
  ContactStudyPlan plan = pressed(500.0, 8000.0, 9);
  std::vector<double> told{0.0};
  ContactStudyOptions options;
  options.progress = [&](double fraction) {
    EXPECT_GE(fraction, told.back());
    EXPECT_LE(fraction, 1.0);
    told.push_back(fraction);
  };
  EXPECT_EQ(study_contact(plan, options).size(), 1U);
  ASSERT_GT(told.size(), 8U);
  EXPECT_GT(told.back(), 0.9);
  // The study stops in the scan, in the refinement, in the first and in the second run of the scene
  // itself.
  const std::vector<double> fractions = told;
  for (const double from : {0.0, fractions[fractions.size() - 5], fractions[fractions.size() - 3],
                            fractions[fractions.size() - 2]}) {
    std::atomic<double> now = 0.0;
    options.progress = [&](double fraction) { now = fraction; };
    options.should_stop = [&] { return now >= from; };
    EXPECT_TRUE(study_contact(plan, options).empty()) << from;
    EXPECT_LT(now, fractions.back());
  }
}

TEST(ContactStudy, OnOneThreadIsTheSameAndStaysOnThatThread) {
  const ContactStudyPlan plan = pressed(500.0, 8000.0, 40);
  ContactStudyOptions options;
  options.threads = 1;
  options.progress = [me = std::this_thread::get_id()](double) {
    EXPECT_EQ(std::this_thread::get_id(), me);
  };
  const std::vector<ContactMetrics> one = study_contact(plan, options);
  const std::vector<ContactMetrics> all = study_contact(plan);
  ASSERT_EQ(one.size(), all.size());
  EXPECT_EQ(one.front().limits.failed.first, all.front().limits.failed.first);
  EXPECT_EQ(one.front().limits.settled.last, all.front().limits.settled.last);
}

}  // namespace
}  // namespace hapticwall
