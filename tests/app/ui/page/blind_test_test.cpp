// A blind test from set-up to files; nothing on the screen reveals its order.
#include "app/ui/state/blind_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "app/ui/state/comparing.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/app/ui/gui_test.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {
namespace {

namespace fs = std::filesystem;
using compare::BlindTrials;
using compare::Presentation;
using compare::Slot;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr std::uint64_t kSeed = 7;
constexpr std::size_t kTrialsOfOrder = 4;

class BlindTestTest : public GuiTest {
 protected:
  void SetUp() override {
    options.recording_folder = folder_.path().string();
    GuiTest::SetUp();
  }
  void start(std::uint64_t seed, int trials) {
    click("page Blind test");
    type("blind seed", std::to_string(seed));
    type("blind trials", std::to_string(trials));
    click("blind start");
    ASSERT_TRUE(ui::blind_test_runs(application_->state()));
  }
  void press_ctrl(ImGuiKey key) {
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, true);
    press(key);
    ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, false);
    frames(1);
  }
  [[nodiscard]] const ui::BlindTest& test() const {
    return *application_->state().compare.transient.test;
  }
  [[nodiscard]] ui::CompareSlots slots() const { return ui::slots_of(application_->state()); }
  [[nodiscard]] bool runs(Slot slot) const { return fake_->scene().algorithm == slots().of(slot); }
  [[nodiscard]] static BlindTrials by_hand(std::uint64_t seed, std::size_t trials) {
    compare::TrialPlan plan;
    plan.seed = seed;
    plan.trials = trials;
    return *BlindTrials::create(plan);
  }
  [[nodiscard]] std::string content(const std::string& name) const { return folder_.content(name); }
  // Another seed that begins with the other slot.
  [[nodiscard]] static std::uint64_t seed_with_first(Slot slot) {
    std::uint64_t seed = 1;
    while (by_hand(seed, kTrialsOfOrder).present(Presentation::kFirst, 0.0) != slot) ++seed;
    return seed;
  }

  TemporaryFolder folder_;
};

TEST_F(BlindTestTest, ClicksAndKeysGiveTheResultOfTheTrialsByHand) {
  constexpr int kTrials = 6;
  const AlgorithmSettings before = fake_->scene().algorithm;
  start(kSeed, kTrials);
  BlindTrials expected = by_hand(kSeed, kTrials);
  for (int trial = 0; trial < kTrials; ++trial) {
    click("feel second");
    EXPECT_TRUE(runs(expected.present(Presentation::kSecond, 0.0)));
    click("choose first");  // too early
    EXPECT_EQ(test().trials.trial(), static_cast<std::size_t>(trial));
    press(trial % 2 == 0 ? ImGuiKey_1 : ImGuiKey_LeftArrow);
    EXPECT_TRUE(runs(expected.present(Presentation::kFirst, 0.0)));
    live(100);
    const bool first = trial % 3 != 0;
    if (trial % 2 == 0) {
      click(first ? "choose first" : "choose second");
    } else {
      press_ctrl(first ? ImGuiKey_1 : ImGuiKey_2);
    }
    ASSERT_FALSE(
        expected.choose(first ? Presentation::kFirst : Presentation::kSecond, 1.0).has_value());
  }
  EXPECT_FALSE(test().running) << "it ends by itself";
  EXPECT_EQ(fake_->scene().algorithm, before);
  const auto& trials = test().trials.trials();
  ASSERT_EQ(trials.size(), expected.trials().size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].first, expected.trials()[i].first);
    EXPECT_EQ(trials[i].chosen, expected.trials()[i].chosen);
    EXPECT_EQ(trials[i].looks, expected.trials()[i].looks);
    EXPECT_GT(trials[i].seconds, 0.0);
  }
  const std::string a = compare::describe(slots().of(Slot::kA));
  const std::string b = compare::describe(slots().of(Slot::kB));
  EXPECT_EQ(test().trials.result_csv(a, b), expected.result_csv(a, b));
  EXPECT_EQ(application_->state().transient.undo.size(), 1U) << "nothing of it is to be undone";
}

TEST_F(BlindTestTest, IsSavedOnceAndNothingIsOverwritten) {
  for (const char* name : {"press-blind-test", "press-blind-test-2"}) {
    start(kSeed, 1);
    press(ImGuiKey_1);
    press(ImGuiKey_2);
    press_ctrl(ImGuiKey_2);
    click("blind save");
    const std::string a = test().a;
    const std::string b = test().b;
    EXPECT_EQ(content(std::string(name) + "-trials.csv"), test().trials.trials_csv(a, b));
    EXPECT_EQ(content(std::string(name) + "-result.csv"), test().trials.result_csv(a, b));
    EXPECT_THAT(message().text, HasSubstr(folder_.file(name) + "-trials.csv"));
    click("blind save");  // it is saved
    click("new blind test");
  }
  EXPECT_EQ(folder_.names().size(), 4U);
}

TEST_F(BlindTestTest, AFolderThatIsNotThereIsTold) {
  start(kSeed, 1);
  press(ImGuiKey_1);
  press(ImGuiKey_2);
  press_ctrl(ImGuiKey_1);
  fs::remove_all(folder_.path());
  click("blind save");
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_TRUE(test().saved_as.empty());
}

TEST_F(BlindTestTest, StopShowsWhatWasAnswered) {
  start(kSeed, 20);
  press(ImGuiKey_1);
  press(ImGuiKey_2);
  press_ctrl(ImGuiKey_2);
  press(ImGuiKey_1);
  click("stop and show");
  EXPECT_FALSE(ui::blind_test_runs(application_->state()));
  EXPECT_EQ(test().trials.result().trials, 1U);
  EXPECT_TRUE(find("p-value").has_value());
  EXPECT_TRUE(runs(Slot::kA));
  click("new blind test");
  click("last result");
  EXPECT_TRUE(find("p-value").has_value());
}

// No item or text that tells of algorithm, force or energy is drawn.
TEST_F(BlindTestTest, NothingThatCouldTellTheOrderIsDrawn) {
  live(3000);
  const auto tells = [](const std::string& name) {
    for (const char* part :
         {"plot P", "plot F",       "plot S",         "legend ",   "algorithm.", "slot ",
          "take ",  "passive",      "penetration",    "magnifier", "ghost",      "bound, ",
          "cost",   "energy error", "reset to scene", "scene",     "Figure",     "cursor table",
          "export", "follow",       "trigger"}) {
      if (name.starts_with(part)) return true;
    }
    return ui::algorithm_name({*find_algorithm("none"), {}}) == name ||
           find_algorithm(name).has_value();
  };
  const auto count_telling = [&] {
    int count = 0;
    for (const auto& [name, item] : drawn_items()) count += tells(name);
    return count;
  };
  EXPECT_GT(count_telling(), 20) << "or the list above would mean nothing";
  start(kSeed, 4);
  for (const ImGuiKey key : {ImGuiKey_1, ImGuiKey_2}) {
    press(key);
    live(500);
    for (const auto& [name, item] : drawn_items()) EXPECT_FALSE(tells(name)) << name;
    for (const ui::ShownStiffness& shown : application_->state().wall.transient.shown)
      EXPECT_EQ(shown.strength, 0.0);
  }
  EXPECT_NE(fake_->snapshot().newest.x().force_n, 0.0) << "in contact, with a force to be hidden";
  EXPECT_TRUE(find("wall view").has_value());
  EXPECT_TRUE(find("feel first").has_value());
}

TEST_F(BlindTestTest, KeysAndButtonsThatCouldTellAreInert) {
  click("passivity-control");
  start(kSeed, 4);
  press(ImGuiKey_1);
  const AlgorithmSettings felt = fake_->scene().algorithm;
  for (const ImGuiKey key : {ImGuiKey_3, ImGuiKey_4, ImGuiKey_Tab}) {
    press(key);
    EXPECT_EQ(fake_->scene().algorithm, felt);
  }
  press_ctrl(ImGuiKey_Z);
  click("undo");
  EXPECT_EQ(fake_->scene().algorithm, felt);
  click("page Plots");
  EXPECT_FALSE(find("plot Position").has_value());
  press(ImGuiKey_P);
  EXPECT_TRUE(fake_->is_paused) << "what tells nothing goes on working";
}

TEST_F(BlindTestTest, ARecordingIsNamedWithoutTheAlgorithm) {
  start(kSeed, 4);
  press(ImGuiKey_2);
  press_ctrl(ImGuiKey_R);
  EXPECT_THAT(fake_->recording_status().path, EndsWith("press-blind-test.csv"));
  EXPECT_THAT(message().text, HasSubstr("press-blind-test.csv"));
}

// In free space both algorithms feel the same, so that both must look the same.
TEST_F(BlindTestTest, TwoOrdersLookTheSame) {
  click("page Blind test");
  const auto picture_of = [&](Slot first) {
    application_->state().compare.persisted.trials = kTrialsOfOrder;
    application_->state().compare.transient.seed = seed_with_first(first);
    application_->state().compare.transient.setting_up = true;
    frames(2);
    click("blind start");
    press(ImGuiKey_R);
    press(ImGuiKey_1);
    live(300);
    move_to(ImVec2(2.0F, 2.0F));
    EXPECT_TRUE(runs(first));
    file::Picture picture = screen();
    click("stop and show");
    return picture;
  };
  static_cast<void>(picture_of(Slot::kA));  // the letters of this page are drawn for the first time
  const file::Picture a = picture_of(Slot::kA);
  const file::Picture b = picture_of(Slot::kB);
  EXPECT_TRUE(a.rgba == b.rgba);
}

TEST_F(BlindTestTest, AnotherSceneEndsItAndWrongSetUpsAreTold) {
  start(kSeed, 4);
  const std::string scene = "tap";
  application_->state().transient.wanted_scene =
      ui::WantedScene{file::load_scene(scene)->scene, true};
  frames(2);
  EXPECT_FALSE(ui::blind_test_runs(application_->state()));
  EXPECT_THAT(message().text, HasSubstr("another session"));
  click("new blind test");
  type("blind trials", "0");
  EXPECT_THAT(message().text, HasSubstr("trials: 0"));
  type("blind confidence", "100");
  EXPECT_THAT(message().text, HasSubstr("confidence: 100"));
  type("blind seed", "many");
  EXPECT_THAT(message().text, HasSubstr("seed: 'many'"));
  EXPECT_EQ(application_->state().compare.persisted.trials, 4U);
}

TEST_F(BlindTestTest, TheHelpNamesTheKeysThatAct) {
  start(kSeed, 4);
  press(ImGuiKey_F1);
  EXPECT_TRUE(find("feel the first wall").has_value());
  EXPECT_FALSE(find("undo the last change").has_value());
}

}  // namespace
}  // namespace hapticwall::test
