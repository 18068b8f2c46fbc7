#include <gtest/gtest.h>

#include "app/runtime/parameter_history.h"
#include "tests/app/runtime_support.h"

namespace hapticwall::runtime {
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

}  // namespace
}  // namespace hapticwall::runtime
