// The study of named hands through its contract: options, plan, outcome, and the end before it.
#include "app/study/named_hands/named_hands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/file/scene/hand_description.h"
#include "app/file/scene/scene_file.h"
#include "app/study/studies.h"

namespace hapticwall::study::named_hands {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

HandsPlan made_up_plan() {
  HandsPlan plan;
  plan.scene.name = "made up";
  plan.scene.x().device.friction_n = 0.14;
  plan.scene.x().device.delay_ticks = 2;
  plan.scene.x().hand = HandSettings{};
  plan.scene.x().hand->stiffness_n_per_m = 7.0;
  plan.hands = {{"first", {}}, {"second", {}}};
  return plan;
}

HandsRow made_up_row() {
  HandsRow row;
  row.algorithm = "none";
  row.own.verdict = Verdict::kMoving;
  row.runs.resize(2);
  row.runs[1].verdict = Verdict::kActive;
  row.runs[1].given_j = 0.5;
  row.runs[1].chatter_n = 0.25;
  return row;
}

TEST(NamedHandsOutcome, HasTheConditionsAndTheWorstHand) {
  const Outcome outcome = outcome_of(made_up_plan(), {made_up_row()});
  EXPECT_THAT(table::sheet_text(outcome.sheet),
              AllOf(HasSubstr("2 hands on the scene's path, friction 0.14 N, delay 2 ticks"),
                    HasSubstr("own hand: no mass, 7 N/m, 0 N s/m, no grip"),
                    HasSubstr("1 of 2  active  active  second")));
  const auto row = nlohmann::json::parse(outcome.json).at("rows").at(0);
  EXPECT_EQ(row.at("own_verdict"), "moving");
  EXPECT_EQ(row.at("worst_hand"), "second");
  EXPECT_EQ(row.at("max_given_j"), 0.5);
  EXPECT_EQ(row.at("median_chatter_n"), 0.25);
  EXPECT_TRUE(row.at("min_displayed_stiffness_n_per_m").is_null());
  EXPECT_EQ(row.at("runs").at(0).at("verdict"), "settled");
  EXPECT_TRUE(row.at("runs").at(0).at("chatter_n").is_null());
}

TEST(NamedHandsStudy, TakesNamesAndFiles) {
  Scene scene = file::load_scene("press")->scene;
  scene.duration_s = 1.2;
  const Study& study = named_hands_study();
  const auto wrong = study.options.front().wrong;
  EXPECT_EQ(wrong("all"), "");
  EXPECT_EQ(wrong("van-beek-arm,fu-cavusoglu-y"), "");
  EXPECT_THAT(wrong("van-beek-arm,nobody"), HasSubstr("'nobody' is neither a file nor"));
  EXPECT_NE(wrong(""), "");
  const auto run = study.plan(scene, {{"hands", "all"}, {"algorithms", "none"}});
  ASSERT_TRUE(run);
  const auto outcome = (*run)({});
  ASSERT_TRUE(outcome);
  const auto json = nlohmann::json::parse(outcome->json);
  EXPECT_EQ(json.at("hands").size(), file::builtin_hands().size());
  EXPECT_EQ(json.at("rows").size(), 1U);
  Means ended;
  ended.should_stop = [] { return true; };
  EXPECT_FALSE((*run)(ended));
  scene.x().hand.reset();
  EXPECT_FALSE(study.plan(scene, {}));
}

}  // namespace
}  // namespace hapticwall::study::named_hands
