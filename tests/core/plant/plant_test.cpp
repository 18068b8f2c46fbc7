#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "core/plant/plant_model.h"
#include "tests/brute_force_scene.h"

namespace hapticwall {
namespace {

using testing::BruteForcePlant;

// The quantities that the tests compare, for a plant of any type.
class AnyPlant {
 public:
  explicit AnyPlant(const Scene& scene) : plant_(make_plant(scene)) {}
  void advance(double force_n) {
    std::visit([&](auto& plant) { plant.advance(force_n); }, plant_);
  }
  [[nodiscard]] PlantTruth truth() const {
    PlantTruth truth;
    std::visit([&](const auto& plant) { plant.write_truth(plant.motion(), truth); }, plant_);
    return truth;
  }
  [[nodiscard]] std::uint64_t friction_events() const {
    return std::visit(
        [](const auto& plant) -> std::uint64_t {
          if constexpr (requires { plant.friction_events(); }) return plant.friction_events();
          return 0;
        },
        plant_);
  }

 private:
  PlantVariant plant_;
};

// A force as rough as a chattering wall's.
double rough_force(int tick) { return (tick * 7) % 5 < 2 ? 3.0 : -0.5 * ((tick * 3) % 4); }

// Force to and fro, so that a handle with friction stops and starts again and again.
double reversing_force(int tick) { return (tick / 4) % 2 == 0 ? 2.0 : -2.0; }

struct Tolerance {
  double position_m;
  double energy_j;
};

AnyPlant compare(const Scene& scene, int ticks, int substeps, Tolerance tolerance,
                 double (*force)(int) = rough_force, int* reference_events = nullptr) {
  AnyPlant plant(scene);
  BruteForcePlant reference = testing::brute_force_plant(scene);
  for (int tick = 0; tick < ticks; ++tick) {
    plant.advance(force(tick));
    reference.advance(force(tick), scene.sampling.period_s(), substeps);
    const PlantTruth truth = plant.truth();
    EXPECT_NEAR(truth.position_m, static_cast<double>(reference.x), tolerance.position_m) << tick;
    EXPECT_NEAR(truth.actuator_work_j, static_cast<double>(reference.actuator_work),
                tolerance.energy_j)
        << tick;
    EXPECT_NEAR(truth.dissipation_j, static_cast<double>(reference.dissipation), tolerance.energy_j)
        << tick;
    EXPECT_NEAR(truth.hand_work_j, static_cast<double>(reference.hand_work), tolerance.energy_j)
        << tick;
    if (::testing::Test::HasFailure()) break;
  }
  if (reference_events != nullptr) *reference_events = reference.events;
  return plant;
}

Scene spring_hand() {
  Scene scene;
  scene.x().device.mass_kg = 0.1;
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 300.0;
  scene.x().hand->damping_n_s_per_m = 5.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.02, 0.035}};
  return scene;
}

Scene grip_hand() {
  Scene scene = spring_hand();
  scene.x().device.mass_kg = 0.05;
  scene.x().hand->mass_kg = 0.4;
  scene.x().hand->grip_stiffness_n_per_m = 1000.0;
  scene.x().hand->grip_damping_n_s_per_m = 1.0;
  return scene;
}

constexpr Tolerance kExact{1e-16, 2e-16};

TEST(ExactPlant, IsTheBruteForceMotionOfAnyHand) {
  Scene no_hand = spring_hand();
  no_hand.x().hand.reset();
  Scene rigid_hand = spring_hand();
  rigid_hand.x().hand->mass_kg = 0.1;
  for (const Scene& scene : {no_hand, spring_hand(), rigid_hand, grip_hand()}) {
    compare(scene, 60, 200, kExact);
  }
}

TEST(ExactPlant, OverdampedCriticalAndUndampedHandsAreTheBruteForceMotion) {
  for (const double damping : {0.0, 2.0 * std::sqrt(300.0 * 0.1) - 1.0, 200.0}) {
    Scene scene = spring_hand();
    scene.x().hand->damping_n_s_per_m = damping;
    compare(scene, 40, 4000, kExact);
    Scene grip = grip_hand();
    grip.x().hand->damping_n_s_per_m = damping;
    compare(grip, 40, 4000, kExact);
  }
}

// The intended path bends in the middle of a tick, and twice within another.
TEST(ExactPlant, FollowsAPathThatBendsBetweenTicks) {
  for (Scene scene : {spring_hand(), grip_hand()}) {
    scene.x().hand->path = {{0.0, 0.03}, {0.0025, 0.0301}, {0.00525, 0.0295}, {0.00575, 0.0305}};
    compare(scene, 10, 4000, kExact);
  }
}

// The brute force cuts its small step at a straight line's root: second order in the step.
constexpr Tolerance kFrictionTolerance{1e-11, 1e-11};

TEST(ExactPlant, SticksAndSlipsLikeTheBruteForceMotion) {
  for (Scene scene : {spring_hand(), grip_hand()}) {
    scene.x().device.friction_n = 0.9;
    scene.x().hand->stiffness_n_per_m = 3000.0;
    scene.x().hand->path = {{0.0, 0.03}, {0.02, 0.0302}, {0.04, 0.0299}};
    int reference_events = 0;
    const AnyPlant plant =
        compare(scene, 60, 2000, kFrictionTolerance, reversing_force, &reference_events);
    EXPECT_EQ(plant.friction_events(), static_cast<std::uint64_t>(reference_events));
    EXPECT_GE(plant.friction_events(), 6U);
  }
}

// The hand moves while the handle sticks, until its pull exceeds the friction.
TEST(ExactPlant, AHandThatMovesOnBreaksAStuckHandleLooseWhenItShould) {
  Scene scene = grip_hand();
  scene.x().device.friction_n = 0.9;
  scene.x().hand->path = {{0.0, 0.03}, {1.0, 0.04}};
  int reference_events = 0;
  const AnyPlant plant = compare(
      scene, 500, 200, kFrictionTolerance, [](int) { return 0.0; }, &reference_events);
  EXPECT_GE(plant.friction_events(), 1U);
  EXPECT_EQ(plant.friction_events(), static_cast<std::uint64_t>(reference_events));
}

TEST(ExactPlant, SticksForEverUnderLessThanTheFriction) {
  Scene scene = spring_hand();
  scene.x().hand.reset();
  scene.x().device.friction_n = 0.5;
  AnyPlant plant(scene);
  for (int i = 0; i < 1000; ++i) plant.advance(i % 2 == 0 ? 0.49 : -0.49);
  EXPECT_EQ(plant.truth().position_m, scene.x().device.start_m);
  EXPECT_EQ(plant.truth().dissipation_j, 0.0);
  plant.advance(0.51);
  EXPECT_LT(plant.truth().position_m, scene.x().device.start_m);
}

// Coulomb's law alone: under constant friction a body stops after v²/(2 f/m).
TEST(ExactPlant, SlidesToRestAsCoulombSays) {
  Scene scene;
  scene.x().device.mass_kg = 0.2;
  scene.x().device.damping_n_s_per_m = 0.0;
  scene.x().device.friction_n = 0.14;
  scene.x().device.start_m = 0.0;
  AnyPlant plant(scene);
  for (int i = 0; i < 20; ++i) plant.advance(-2.14);  // net 2 N for 20 ms: 0.2 m/s, 2 mm
  EXPECT_NEAR(plant.truth().velocity_m_per_s, 0.2, 1e-15);
  for (int i = 0; i < 400; ++i) plant.advance(0.0);
  const double slide_m = 0.2 * 0.2 / (2.0 * 0.14 / 0.2);
  EXPECT_EQ(plant.truth().velocity_m_per_s, 0.0);
  EXPECT_NEAR(plant.truth().position_m, 0.002 + slide_m, 1e-15);
  EXPECT_NEAR(plant.truth().dissipation_j, 0.14 * (0.002 + slide_m), 1e-15);
}

// Rates far beyond the sampling: pieces of a tick are taken by halves of halves where nothing can
// happen in them. The tolerance is the reference's, which cuts its step at a straight line's root:
// with 320000 substeps the two agree to 5e-13.
TEST(ExactPlant, StiffHandlesWithFrictionMoveLikeTheBruteForceMotion) {
  for (Scene scene : {spring_hand(), grip_hand()}) {
    scene.x().device.mass_kg = 1e-4;
    scene.x().device.damping_n_s_per_m = 5.0;
    scene.x().device.friction_n = 0.2;
    scene.sampling.rate_hz = 100.0;
    const auto force = [](int tick) { return 0.6 * reversing_force(4 * tick); };
    int reference_events = 0;
    const AnyPlant plant = compare(scene, 6, 80000, {1e-10, 1e-10}, force, &reference_events);
    EXPECT_GE(plant.friction_events(), 1U);
    EXPECT_EQ(plant.friction_events(), static_cast<std::uint64_t>(reference_events));
  }
}

// Cutting a tick in two must not change where it ends.
TEST(ExactPlant, HalfTheStepTwiceIsTheSame) {
  for (Scene scene : {spring_hand(), grip_hand()}) {
    for (const double friction : {0.0, 0.3}) {
      if (friction > 0.0) scene.x().device.friction_n = friction;
      Scene half = scene;
      half.sampling.rate_hz *= 2.0;
      AnyPlant whole(scene);
      AnyPlant halves(half);
      for (int tick = 0; tick < 300; ++tick) {
        whole.advance(rough_force(tick));
        halves.advance(rough_force(tick));
        halves.advance(rough_force(tick));
      }
      EXPECT_NEAR(whole.truth().position_m, halves.truth().position_m, 1e-15);
      EXPECT_NEAR(whole.truth().hand_work_j, halves.truth().hand_work_j, 1e-15);
      EXPECT_NEAR(whole.truth().dissipation_j, halves.truth().dissipation_j, 1e-15);
    }
  }
}

TEST(PlantModel, ResetsToTheStart) {
  PlantModel model(grip_hand());
  const PlantTruth start = model.truth();
  for (int i = 0; i < 30; ++i) model.advance(1.0);
  EXPECT_NE(model.truth().position_m, start.position_m);
  model.reset();
  EXPECT_EQ(model.truth().position_m, start.position_m);
  EXPECT_EQ(model.truth().hand_work_j, 0.0);
  EXPECT_EQ(model.truth().hand_path_m, start.hand_path_m);
}

TEST(PlantModel, MeasuresThroughItsEncoder) {
  Scene scene = spring_hand();
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.start_m = 0.0301;
  EXPECT_DOUBLE_EQ(PlantModel(scene).measured_position_m(), 119 * 0.254e-3);
}

}  // namespace
}  // namespace hapticwall
