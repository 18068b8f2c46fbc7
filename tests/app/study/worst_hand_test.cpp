#include "app/study/worst_hand/worst_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/file/scene/scene_file.h"
#include "app/study/studies.h"
#include "core/run/simulate.h"

namespace hapticwall::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Scene tap(double duration_s) {
  Scene scene = file::load_scene("tap")->scene;
  scene.duration_s = duration_s;
  return scene;
}

Outcome outcome(const Scene& scene, const Choices& choices) {
  const auto run = worst_hand_study().plan(scene, choices);
  EXPECT_TRUE(run.ok());
  return (*run)({}).value();
}

TEST(WorstHandStudy, TheSceneFileTakesTheEnergyOfTheTableToTheLastDigit) {
  const Outcome result =
      outcome(tap(1.5), {{"hands", "60"}, {"algorithms", "none,force-bounding"}});
  const auto rows = nlohmann::json::parse(result.json).at("rows");
  ASSERT_EQ(rows.size(), 2U);
  const auto& none = rows[0];
  EXPECT_EQ(none.at("algorithm"), "none");
  EXPECT_EQ(none.at("hands"), 60);
  EXPECT_TRUE(rows[1].at("most_j").is_null());
  EXPECT_TRUE(rows[1].at("first_hand").is_null());
  const auto scene = file::parse_scene(result.scene, "found.toml");
  ASSERT_TRUE(scene.ok()) << result.scene;
  const Summary run = simulate(scene->scene).summary;
  EXPECT_EQ(run.algorithm, "none");
  EXPECT_EQ(none.at("taken_j"), -*run.passivity_margin_j);
  EXPECT_EQ(none.at("stiffness_n_per_m"), scene->scene.x().hand->stiffness_n_per_m);
}

// A search proves that energy was taken, and nothing else.
TEST(WorstHandStudy, TheTableClaimsNoMoreThanASearchShows) {
  const Outcome result =
      outcome(tap(1.0), {{"hands", "200"}, {"algorithms", "none,force-bounding"}});
  std::string text = table::sheet_text(result.sheet) + result.figure->note +
                     result.figure->subject + result.figure->missing + result.scene;
  for (char& letter : text) letter = static_cast<char>(std::tolower(letter));
  for (const char* claim : {"passive", "the worst", "a human can"})
    EXPECT_THAT(text, Not(HasSubstr(claim)));
  EXPECT_THAT(text, HasSubstr("no hand took 1e-9 j; that proves nothing"));
  EXPECT_THAT(text, HasSubstr("no hand found: force-bounding"));
}

TEST(WorstHandStudy, TheCsvHasTheBoundsAndTheSeed) {
  const Outcome result =
      outcome(tap(1.0), {{"hands", "100"}, {"bounds", "narrow"}, {"seed", "18446744073709551615"}});
  EXPECT_THAT(result.csv,
              StartsWith("scene,duration_s,wall_stiffness_n_per_m,bounds,motion,seed,planned_hands,"
                         "algorithm,hands,refused_hands,first_hand,most_j,typical_j,least_j,"));
  EXPECT_THAT(result.csv,
              HasSubstr(",narrow,let-go,18446744073709551615,100,energy-bounding,100,0,"));
}

TEST(WorstHandStudy, ALinearLoopHasItsCriterion) {
  Scene scene = tap(1.0);
  scene.x().device.friction_n.reset();
  scene.x().device.encoder_m.reset();
  scene.x().walls.front().stiffness_n_per_m = 2500.0;
  const Outcome result = outcome(scene, {{"hands", "50"}, {"algorithms", "none,energy-bounding"}});
  const auto rows = nlohmann::json::parse(result.json).at("rows");
  EXPECT_NEAR(rows[0].at("needed_damping_n_s_per_m").get<double>(), 1.25, 1e-6);
  EXPECT_TRUE(rows[1].at("needed_damping_n_s_per_m").is_null());
  EXPECT_THAT(
      result.sheet.marks,
      HasSubstr("under none, in contact, no hand takes energy if b > 1.25 N s/m; this device has "
                "1; springs of 0 to 128810 N/m are unstable; handle and hand of more than "
                "0.000813052 kg in all are unstable\n"));
  scene.x().walls.front().stiffness_n_per_m = 2010.0;
  EXPECT_THAT(outcome(scene, {{"hands", "1"}, {"algorithms", "none"}}).sheet.marks,
              HasSubstr("handle and hand of more than 0.0334995 kg in all are unstable\n"));
}

TEST(WorstHandStudy, RampsHaveASpeedAndTheEnergyAfterTheirEnd) {
  const Outcome result =
      outcome(tap(1.5), {{"hands", "100"}, {"algorithms", "none"}, {"motion", "ramp"}});
  const auto json = nlohmann::json::parse(result.json);
  EXPECT_EQ(json.at("motion"), "ramp");
  const auto& row = json.at("rows")[0];
  EXPECT_GE(row.at("speed_m_per_s").get<double>(), 0.01);
  EXPECT_GT(row.at("taken_at_rest_j").get<double>(), 0.0);
  EXPECT_THAT(table::sheet_text(result.sheet), HasSubstr("energy counts after their end"));
  const auto scene = file::parse_scene(result.scene, "found.toml");
  ASSERT_TRUE(scene.ok()) << result.scene;
  EXPECT_EQ(row.at("taken_j"), -*simulate(scene->scene).summary.passivity_margin_j);
  const Outcome let_go = outcome(tap(1.5), {{"hands", "20"}, {"algorithms", "none"}});
  const auto other = nlohmann::json::parse(let_go.json).at("rows")[0];
  EXPECT_TRUE(other.at("speed_m_per_s").is_null());
  EXPECT_EQ(other.at("taken_j"), other.at("taken_at_rest_j"));
}

TEST(WorstHandStudy, TheTimeEndsASearchWithTheHandsSoFar) {
  const Outcome result = outcome(tap(0.1), {{"hands", "5000"}, {"seconds", "1e-9"}});
  EXPECT_EQ(nlohmann::json::parse(result.json).at("rows")[0].at("hands"), 1024);
  EXPECT_THAT(result.sheet.marks, HasSubstr("the time was up before 5000 hands"));
}

TEST(WorstHandStudy, RefusesWrongOptionsAndScenesWithoutAWall) {
  const auto wrong = [](std::string_view key, std::string_view text) {
    return std::ranges::find(worst_hand_study().options, key, &Option::key)->wrong(text);
  };
  for (const char* text : {"", "0", "-1", "1.5", "10000001"}) EXPECT_NE(wrong("hands", text), "");
  for (const char* text : {"", "-1", "18446744073709551616"}) EXPECT_NE(wrong("seed", text), "");
  for (const char* text : {"", "Wide", "huge"}) EXPECT_NE(wrong("bounds", text), "");
  for (const char* text : {"", "Ramp", "reversal"}) EXPECT_NE(wrong("motion", text), "");
  for (const char* text : {"0", "-1", "nan", "1e7"}) EXPECT_NE(wrong("seconds", text), "");
  EXPECT_NE(wrong("algorithms", "none,nope"), "");
  EXPECT_EQ(wrong("algorithms", "none,half-sample"), "");
  Scene bare = tap(1.0);
  bare.x().walls.clear();
  const auto run = worst_hand_study().plan(bare, {});
  ASSERT_FALSE(run.ok());
  EXPECT_THAT(run.error().message, HasSubstr("wall"));
}

}  // namespace
}  // namespace hapticwall::study
