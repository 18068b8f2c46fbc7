#include "app/session/plant_keeper.h"

#include <gtest/gtest.h>

#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;

Scene with_mass(double mass_kg) {
  Scene scene = contact_scene();
  scene.x().device.mass_kg = mass_kg;
  return scene;
}

TEST(PlantKeeper, AChangeBesideThePlantNeedsNoNewOne) {
  PlantKeeper keeper(contact_scene());
  EXPECT_EQ(keeper.plant_for(test::with_algorithm(contact_scene(), 0), 2, false), nullptr);
  PlantModel* heavy = keeper.plant_for(with_mass(0.2), 3, false);
  ASSERT_NE(heavy, nullptr);
  EXPECT_EQ(keeper.plant_for(test::with_algorithm(with_mass(0.2), 0), 4, false), heavy);
  EXPECT_EQ(keeper.count(), 1U);
}

TEST(PlantKeeper, FreesWhatWasReplacedOnlyWhenTheLoopSaysSo) {
  PlantKeeper keeper(contact_scene());
  PlantModel* first = keeper.plant_for(with_mass(0.1), 2, false);
  keeper.came_into_force(2);
  EXPECT_EQ(keeper.count(), 1U);
  PlantModel* second = keeper.plant_for(with_mass(0.2), 3, false);
  EXPECT_NE(first, second);
  EXPECT_EQ(keeper.count(), 2U) << "the loop may still be reading the first";
  keeper.came_into_force(2);
  EXPECT_EQ(keeper.count(), 2U);
  keeper.came_into_force(3);
  EXPECT_EQ(keeper.count(), 1U);
  EXPECT_EQ(keeper.plant_for(with_mass(0.2), 4, false), second);
}

TEST(PlantKeeper, APlantThatTheLoopNeverSawIsFreedAtOnce) {
  PlantKeeper keeper(contact_scene());
  bool unread = false;
  for (std::uint32_t generation = 2; generation < 1000; ++generation) {
    ASSERT_NE(keeper.plant_for(with_mass(1.0 + 1e-3 * generation), generation, unread), nullptr);
    ASSERT_EQ(keeper.count(), 1U);
    unread = true;
  }
}

TEST(PlantKeeper, AnUnseenPlantServesTheNextParametersToo) {
  PlantKeeper keeper(contact_scene());
  PlantModel* heavy = keeper.plant_for(with_mass(0.2), 2, false);
  EXPECT_EQ(keeper.plant_for(test::with_algorithm(with_mass(0.2), 0), 3, true), heavy);
  keeper.came_into_force(3);
  EXPECT_EQ(keeper.count(), 1U);
  // Seen with 3; that 4 was not seen does not make it unseen.
  EXPECT_EQ(keeper.plant_for(test::with_algorithm(with_mass(0.2), 1), 4, false), heavy);
  EXPECT_EQ(keeper.plant_for(with_mass(0.2), 5, true), heavy);
  EXPECT_NE(keeper.plant_for(with_mass(0.3), 6, true), heavy);
  EXPECT_EQ(keeper.count(), 2U);
}

TEST(PlantKeeper, AChangeAndBackAgainIsNoneWhereTheLoopSawNeither) {
  PlantKeeper unseen(contact_scene());
  static_cast<void>(unseen.plant_for(with_mass(0.2), 2, false));
  EXPECT_EQ(unseen.plant_for(contact_scene(), 3, true), nullptr);
  EXPECT_EQ(unseen.count(), 0U);
  PlantKeeper seen(contact_scene());
  PlantModel* heavy = seen.plant_for(with_mass(0.2), 2, false);
  PlantModel* light = seen.plant_for(contact_scene(), 3, false);
  EXPECT_NE(light, nullptr) << "the first plant has handed everything over";
  EXPECT_NE(light, heavy);
}

}  // namespace
}  // namespace hapticwall::session
