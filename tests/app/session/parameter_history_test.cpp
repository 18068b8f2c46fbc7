#include "app/session/parameter_history.h"

#include <gtest/gtest.h>

#include "app/file/recording/sidecar.h"
#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;

TEST(ParameterHistory, KnowsTheStartAndTheChangesOfTheRunThatGoesOn) {
  const Scene first = contact_scene();
  ParameterHistory history(first);
  history.came_into_force({0, 1});
  const Scene second = test::with_algorithm(first, 0);
  const Scene third = test::with_algorithm(first, 2);
  history.add(second);
  history.add(third);
  EXPECT_EQ(history.generation(), 3U);
  history.came_into_force({40, 3});  // the second was overtaken
  EXPECT_EQ(history.scene_at_start().algorithm, first.algorithm);
  ASSERT_EQ(history.changes_before(1000).size(), 1U);
  EXPECT_EQ(history.changes_before(1000)[0].tick, 40U);
  EXPECT_EQ(history.changes_before(1000)[0].scene.algorithm, third.algorithm);
  EXPECT_TRUE(history.changes_before(40).empty());
  EXPECT_EQ(history.changes_before(41).size(), 1U);

  history.came_into_force({0, 3});  // a reset
  EXPECT_EQ(history.scene_at_start().algorithm, third.algorithm);
  EXPECT_TRUE(history.changes_before(1000).empty());
  EXPECT_EQ(history.newest().algorithm, third.algorithm);
}

TEST(ParameterHistory, KeepsEveryPartThatChangedAndThePathOfTheStart) {
  const Scene first = contact_scene();
  ParameterHistory history(first);
  history.came_into_force({0, 1});
  std::uint64_t tick = 0;
  const std::vector<Scene> changes = test::plant_changes(first);
  for (const Scene& changed : changes) {
    history.add(changed);
    history.came_into_force({++tick, history.generation()});
  }
  const auto told = history.changes_before(1000);
  ASSERT_EQ(told.size(), changes.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].scene.x().device, changes[i].x().device);
    HandSettings hand = changes[i].x().hand.value();
    hand.path = {};
    EXPECT_EQ(told[i].scene.x().hand, hand);
    EXPECT_EQ(told[i].scene.simulator, changes[i].simulator);
    EXPECT_EQ(told[i].scene.algorithm, changes[i].algorithm);
  }
  EXPECT_EQ(history.scene_at_start().x().device, first.x().device);
  EXPECT_EQ(history.scene_at_start().x().hand, first.x().hand);
}

TEST(ParameterHistory, KeepsAChangedEstimator) {
  const Scene first = contact_scene();
  ParameterHistory history(first);
  history.came_into_force({0, 1});
  Scene changed = first;
  changed.estimator.values.back() = 30.0;
  history.add(changed);
  history.came_into_force({40, 2});
  EXPECT_EQ(history.scene_at_start().estimator, first.estimator);
  ASSERT_EQ(history.changes_before(41).size(), 1U);
  EXPECT_EQ(history.changes_before(41)[0].scene.estimator, changed.estimator);
}

TEST(ParameterHistory, SaysWhetherItKnowsHowTheRunBegan) {
  ParameterHistory history(contact_scene());
  EXPECT_FALSE(history.knows_start());
  const std::uint64_t before = history.revision();
  history.came_into_force({0, 1});
  EXPECT_TRUE(history.knows_start());
  EXPECT_NE(history.revision(), before) << "though there is no change";
  history.restart();
  EXPECT_FALSE(history.knows_start());
  history.came_into_force({40, 1});  // belongs to the run before
  EXPECT_FALSE(history.knows_start());
  history.came_into_force({0, 1});
  EXPECT_TRUE(history.knows_start());
}

TEST(ParameterHistory, SaysWhereThereWereMoreChangesThanItKeeps) {
  const Scene first = contact_scene();
  ParameterHistory history(first);
  history.came_into_force({0, 1});
  for (std::size_t i = 1; i <= file::kMaxChanges + 1; ++i) {
    EXPECT_FALSE(history.has_lost_changes());
    history.add(test::with_algorithm(first, i % 2));
    history.came_into_force({i, history.generation()});
  }
  EXPECT_TRUE(history.has_lost_changes());
  EXPECT_EQ(history.changes_before(1'000'000).size(), file::kMaxChanges);
  history.came_into_force({0, history.generation()});
  EXPECT_FALSE(history.has_lost_changes());
}

TEST(ParameterHistory, AChangeThatWasTakenBackUnreadIsForgotten) {
  const Scene first = contact_scene();
  ParameterHistory history(first);
  history.came_into_force({0, 1});
  history.add(test::with_algorithm(first, 0));
  history.add(test::with_algorithm(first, 1), true);
  history.add(test::with_algorithm(first, 2), true);
  EXPECT_EQ(history.generation(), 4U);
  history.came_into_force({9, 4});
  ASSERT_EQ(history.changes_before(1000).size(), 1U);
  EXPECT_EQ(history.changes_before(1000)[0].scene.algorithm.index, 2U);
}

}  // namespace
}  // namespace hapticwall::session
