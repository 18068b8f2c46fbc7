// A blind test of equal trials; nothing on the screen reveals its order.
#include "app/ui/state/blind_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/file/trials/trial_list.h"
#include "app/ui/state/comparing.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

namespace fs = std::filesystem;
using compare::BlindTrials;
using compare::Presentation;
using compare::Slot;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr int kTrialsOfOrder = 4;

class BlindTestTest : public GuiTest {
 protected:
  void SetUp() override {
    options.recording_folder = path("");
    GuiTest::SetUp();
  }
  // Feels both walls, and chooses one with this key.
  void answer(ImGuiKey choice) {
    press(ImGuiKey_1);
    press(ImGuiKey_2);
    press(ImGuiMod_Ctrl | choice);
  }
  [[nodiscard]] const ui::BlindTest& test() const { return *state().compare.transient.test; }
  [[nodiscard]] bool runs(Slot slot) const {
    const auto& scenes = test().experiment->scenes[test().trials.place()];
    return scene().algorithm == scenes[slot == Slot::kA ? 0 : 1].algorithm;
  }
  // Starts with a participant whose first wall is this slot.
  void start_with_first(Slot slot) {
    for (int person = 1;; ++person) {
      start_trials(kTrialsOfOrder, "algorithm=none", "algorithm=energy-bounding",
                   "P" + std::to_string(person));
      BlindTrials copy = test().trials;
      if (copy.present(Presentation::kFirst, 0.0) == slot) return;
    }
  }
  std::vector<file::Answer> by_hand_;
};

TEST_F(BlindTestTest, ClicksAndKeysGiveTheResultOfTheTrialsByHand) {
  constexpr int kTrials = 6;
  start_trials(kTrials);
  BlindTrials expected = test().trials;
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
      press(ImGuiMod_Ctrl | (first ? ImGuiKey_1 : ImGuiKey_2));
    }
    by_hand_.push_back(*expected.answer(first ? Presentation::kFirst : Presentation::kSecond, 1.0));
    expected.take();
  }
  EXPECT_FALSE(test().running) << "it ends by itself";
  const std::vector<file::Answer>& answers = test().answers;
  ASSERT_EQ(answers.size(), by_hand_.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i].first, by_hand_[i].first);
    EXPECT_EQ(answers[i].chosen, by_hand_[i].chosen);
    EXPECT_EQ(answers[i].looks, by_hand_[i].looks);
    EXPECT_GT(answers[i].seconds, 0.0);
    EXPECT_EQ(answers[i].a, "algorithm=none");
    EXPECT_EQ(answers[i].b, "algorithm=energy-bounding");
  }
  EXPECT_EQ(test().results.tests.chose_a, compare::results_of(by_hand_, 0.95).tests.chose_a);
}

// Stronger than an observer at chance: no pixel tells. The sound is the masking noise, which is
// the same for every handle (sound_pump_test.cpp).
TEST_F(BlindTestTest, NoPixelTellsAWallThatChattersFromOneThatIsQuiet) {
  constexpr int kMoments = 20;
  constexpr int kTicksApart = 150;
  const auto pictures_of = [&](Slot slot) {
    open("press");
    start_with_first(slot);
    press(ImGuiKey_1);
    EXPECT_TRUE(runs(slot));
    move_away();
    std::vector<file::Picture> pictures;
    for (int moment = 0; moment < kMoments; ++moment) {
      live(kTicksApart);
      pictures.push_back(screen());
    }
    EXPECT_GT(newest().time_s, 1.0);
    return pictures;
  };
  // Afterwards all glyphs have their places in the atlas.
  for (const Slot slot : {Slot::kA, Slot::kB}) pictures_of(slot);
  const std::vector<file::Picture> chatters = pictures_of(Slot::kA);
  const std::vector<file::Picture> quiet = pictures_of(Slot::kB);
  for (std::size_t i = 0; i < chatters.size(); ++i)
    EXPECT_LE(pixels_that_differ(chatters[i], quiet[i]), kGlyphEdge) << "moment " << i;
}

using Grey = std::vector<std::uint8_t>;

Grey grey(const file::Picture& picture) {
  Grey result;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    result.push_back(static_cast<std::uint8_t>(
        (picture.rgba[i] + picture.rgba[i + 1] + picture.rgba[i + 2]) / 3));
  return result;
}

struct Shown {
  Slot slot;
  Grey picture;
};

std::size_t index_of(Slot slot) { return slot == Slot::kA ? 0 : 1; }

// An observer who has been told the wall of each look of the first half: a picture of the second is
// that of the wall whose mean picture is nearer. The page tells the trial, so halves, not turns.
std::size_t count_recognised(const std::vector<Shown>& looks) {
  const auto half = static_cast<std::ptrdiff_t>(looks.size() / 2);
  const std::size_t pixels = looks.front().picture.size();
  std::array<std::vector<double>, 2> means{std::vector<double>(pixels),
                                           std::vector<double>(pixels)};
  std::array<double, 2> told{};
  for (const Shown& look : std::span(looks).first(looks.size() / 2)) {
    const std::size_t wall = index_of(look.slot);
    ++told.at(wall);
    for (std::size_t i = 0; i < pixels; ++i)
      means.at(wall)[i] += (look.picture[i] - means.at(wall)[i]) / told.at(wall);
  }
  return static_cast<std::size_t>(
      std::count_if(looks.begin() + half, looks.end(), [&](const Shown& look) {
        double nearer_a = 0.0;
        for (std::size_t i = 0; i < pixels; ++i) {
          const double to_a = look.picture[i] - means[0][i];
          const double to_b = look.picture[i] - means[1][i];
          nearer_a += to_b * to_b - to_a * to_a;
        }
        return (nearer_a > 0.0) == (look.slot == Slot::kA);
      }));
}

TEST_F(BlindTestTest, AnObserverOfPixelsIsAtChance) {
  constexpr int kTrials = 100;  // of two looks each
  constexpr int kTicksALook = 400;
  open("press");
  live(1500);
  start_trials(kTrials);
  std::vector<Shown> looks;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (const ImGuiKey wall : {ImGuiKey_1, ImGuiKey_2}) {
      press(wall);
      move_away();
      live(kTicksALook + trial % 20);  // a cycle of the chattering wall takes 20 ticks
      looks.push_back({runs(Slot::kA) ? Slot::kA : Slot::kB, grey(screen())});
    }
    if (trial + 1 < kTrials) press(ImGuiMod_Ctrl | ImGuiKey_1);
  }
  // 50 of 100 in the mean; with a probability of 1 in 1000 above 66 or below 34.
  EXPECT_NEAR(static_cast<double>(count_recognised(looks)), 50.0, 16.0);
}

TEST_F(BlindTestTest, ThePageWritesAListOfEqualTrialsAndOverwritesNothing) {
  press(ImGuiKey_1);  // A: none
  press(ImGuiKey_Tab);
  press(ImGuiKey_4);  // B: energy bounding
  click("page Blind test");
  type("blind question", "Which is harder, or \"stiffer\"?");
  type("blind trials", "3");
  for (const char* name : {"press-blind-test.csv", "press-blind-test-2.csv"}) {
    click("blind list");
    EXPECT_THAT(message().text,
                HasSubstr("'hapticwall press --trials " + path("") + name + " --participant P01'"));
    const auto list = file::read_trial_list(path(name));
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_EQ(list->trials.size(), 3U);
    for (const file::TrialSpec& trial : list->trials) {
      EXPECT_EQ(trial.slots[0], "algorithm=none");
      EXPECT_EQ(trial.slots[1], "algorithm=energy-bounding; algorithm.rest_force_step_n=0.01");
      EXPECT_EQ(trial.question, "Which is harder, or \"stiffer\"?");
    }
  }
  const auto experiment =
      session::open_experiment({path("press-blind-test.csv"), "P1", "1", path("a.csv"), false},
                               [](std::span<const std::string> overrides) -> Result<Scene> {
                                 return file::load_scene("press", overrides)->scene;
                               });
  ASSERT_TRUE(experiment) << experiment.error().message;
  EXPECT_EQ((*experiment)->scenes.front()[1].algorithm, ui::slots_of(state().compare).of(Slot::kB));
}

TEST_F(BlindTestTest, AFolderThatIsNotThereIsTold) {
  click("page Blind test");
  fs::remove_all(folder_.path());
  click("blind list");
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
}

TEST_F(BlindTestTest, StopShowsWhatWasAnswered) {
  start_trials(20);
  answer(ImGuiKey_2);
  press(ImGuiKey_1);
  click("stop and show");
  EXPECT_FALSE(ui::blind_test_runs(state().compare));
  EXPECT_EQ(test().results.tests.trials, 1U);
  EXPECT_TRUE(sees("chose the first"));
  click("new blind test");
  EXPECT_FALSE(sees("chose the first"));
  click("last result");
  EXPECT_TRUE(sees("chose the first"));
}

// No item or text with information about algorithm, force or energy is drawn.
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
  EXPECT_GT(count_telling(), 20) << "the list above must name real items";
  start_trials(4);
  for (const ImGuiKey key : {ImGuiKey_1, ImGuiKey_2}) {
    press(key);
    live(500);
    for (const auto& [name, item] : drawn_items()) EXPECT_FALSE(tells(name)) << name;
    for (const ui::ShownStiffness& shown : state().wall.transient.shown)
      EXPECT_EQ(shown.strength, 0.0);
  }
  EXPECT_NE(newest().force_n, 0.0) << "in contact, with a force to be hidden";
  EXPECT_TRUE(sees("wall view"));
  EXPECT_TRUE(sees("feel first"));
}

TEST_F(BlindTestTest, KeysAndButtonsThatCouldTellAreInert) {
  click("passivity-control");
  start_trials(4);
  press(ImGuiKey_1);
  const AlgorithmSettings felt = scene().algorithm;
  for (const ImGuiKey key : {ImGuiKey_3, ImGuiKey_4, ImGuiKey_Tab}) {
    press(key);
    EXPECT_EQ(scene().algorithm, felt);
  }
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  click("undo");
  EXPECT_EQ(scene().algorithm, felt);
  show_page(state().dock, ui::kPlotsPage);
  press(ImGuiKey_F3);
  EXPECT_FALSE(sees("plot Position"));
  press(ImGuiKey_P);
  EXPECT_TRUE(fake_->is_paused) << "a key without information works";
}

TEST_F(BlindTestTest, ARecordingIsNamedWithoutTheAlgorithm) {
  start_trials(4);
  press(ImGuiKey_2);
  press(ImGuiMod_Ctrl | ImGuiKey_R);
  EXPECT_THAT(fake_->recording_status().path, EndsWith("press-blind-test.csv"));
  EXPECT_THAT(message().text, HasSubstr("press-blind-test.csv"));
}

// In free space both algorithms feel the same, so they must also look the same.
TEST_F(BlindTestTest, TwoOrdersLookTheSame) {
  const auto picture_of = [&](Slot first) {
    start_with_first(first);
    press(ImGuiKey_R);
    press(ImGuiKey_1);
    live(300);
    move_away();
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
  start_trials(4);
  const std::string scene = "tap";
  state().scene.wanted = ui::WantedScene{file::load_scene(scene)->scene, true};
  frames(5);
  EXPECT_FALSE(ui::blind_test_runs(state().compare));
  EXPECT_THAT(message().text, HasSubstr("another session"));
  click("new blind test");
  type("blind trials", "0");
  ASSERT_TRUE(refusal());
  EXPECT_THAT(refusal()->why, HasSubstr("0 is no whole number"));
  type("blind confidence", "100");
  EXPECT_THAT(refusal()->why, HasSubstr("100 is not from"));
  EXPECT_EQ(state().compare.persisted.trials, 20U);
}

TEST_F(BlindTestTest, TheHelpNamesTheKeysThatAct) {
  start_trials(4);
  press(ImGuiKey_F1);
  EXPECT_TRUE(sees("feel the first wall"));
  EXPECT_FALSE(sees("undo the last change"));
}

}  // namespace
}  // namespace hapticwall::test
