// Plays the tour as README.md tells it, and finds its claims on the verdict strip.
#include "app/ui/state/tour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <string>

#include "app/ui/panel/tour_strip.h"
#include "tests/app/ui/gui_test.h"
#include "tests/paths.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::TourStep;

constexpr int kLongEnough = 6000;  // ticks

class TourTest : public GuiTest {
 protected:
  TourTest() { shows_everything = false; }

  void press_key(char key) {
    press(key == 'R' ? ImGuiKey_R : static_cast<ImGuiKey>(ImGuiKey_0 + (key - '0')));
    live(kLongEnough);
  }
  // "Press 1 until the wall chatters, then 4." presses 1, waits, and presses 4.
  void follow(const std::string& text) {
    static const std::regex kKey("(?:Press|then) ([1-9R])\\b");
    for (std::sregex_iterator key(text.begin(), text.end(), kKey); key != std::sregex_iterator();
         ++key)
      press_key((*key)[1].str().front());
  }
  // A word must be there; a number must be there when it is rounded to the digits of the claim.
  void expect_on_strip(const std::string& claim) const {
    const std::string strip = draw::tail_text(state().tails.front());
    static const std::regex kNumber("([0-9.]+) ([a-zA-Z/]+)");
    std::smatch wanted;
    if (!std::regex_match(claim, wanted, kNumber)) {
      EXPECT_THAT(strip, HasSubstr(claim));
      return;
    }
    const std::string digits = wanted[1].str();
    const std::size_t point = digits.find('.');
    const double half = 0.5 * std::pow(10.0, point == std::string::npos
                                                 ? 0.0
                                                 : -static_cast<double>(digits.size() - point - 1));
    bool found = false;
    for (std::sregex_iterator it(strip.begin(), strip.end(), kNumber); it != std::sregex_iterator();
         ++it)
      found = found ||
              ((*it)[2] == wanted[2] && std::abs(std::stod((*it)[1]) - std::stod(digits)) <= half);
    EXPECT_TRUE(found) << claim << " in: " << strip;
  }
  void expect_claims(const std::string& text) const {
    std::string claims = text.substr(text.rfind(": ") + 2);
    claims.pop_back();  // the full stop
    static const std::regex kComma(", ");
    for (std::sregex_token_iterator claim(claims.begin(), claims.end(), kComma, -1), end;
         claim != end; ++claim)
      expect_on_strip(*claim);
  }
};

TEST_F(TourTest, EveryLessonIsSeenAsItsTextSays) {
  click("begin tour");
  EXPECT_EQ(scene().name, ui::kTourScene);
  const auto steps = ui::tour_steps();
  ASSERT_EQ(std::set<std::string_view>({steps[0].lesson, steps[1].lesson, steps[2].lesson,
                                        steps[3].lesson, steps[4].lesson})
                .size(),
            5U);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    SCOPED_TRACE(steps[i].text);
    EXPECT_EQ(state().tour.step, i + 1);
    EXPECT_FALSE(state().tour.step_done);
    follow(std::string(steps[i].text));
    frames(2);
    EXPECT_TRUE(state().tour.step_done) << draw::tail_text(state().tails.front());
    EXPECT_TRUE(sees("· seen"));
    expect_claims(std::string(steps[i].text));
    if (i + 1 < steps.size()) click("tour next");
  }
  click("close tour");
  EXPECT_FALSE(sees("· seen"));
  EXPECT_FALSE(sees("begin tour")) << "it is offered once";
}

TEST_F(TourTest, AnotherSceneLeavesIt) {
  click("begin tour");
  EXPECT_EQ(state().tour.step, 1U);
  click("scene");
  click("scene tap");
  EXPECT_EQ(scene().name, "tap");
  EXPECT_EQ(state().tour.step, 0U);
}

TEST_F(TourTest, TheReadmeTellsTheSame) {
  std::string readme = text_of(data_folder() + "/../README.md");
  readme = std::regex_replace(readme, std::regex("\\s+"), " ");
  for (const TourStep& step : ui::tour_steps()) {
    EXPECT_THAT(readme, HasSubstr(std::string(step.text)));
    EXPECT_THAT(readme, HasSubstr("**" + std::string(step.lesson) + ".**"));
  }
}

TEST_F(TourTest, ANewcomerSeesTheWallTwoPlotsAndTheAlgorithmsAndMoreOpensTheRest) {
  for (const char* item :
       {"plot Position", "plot Force", "wall view", "none", "more", "begin tour"})
    EXPECT_TRUE(sees(item)) << item;
  for (const char* item : {"plot Stiffness", "magnifier", "damping", "page Timing", "freeze"})
    EXPECT_FALSE(sees(item)) << item;
  click("more");
  for (const char* item : {"plot Stiffness", "magnifier", "damping", "page Timing"})
    EXPECT_TRUE(sees(item)) << item;
  click("settings");
  click("reset layout");
  EXPECT_FALSE(state().window.more);
  EXPECT_EQ(state().plots.persisted.arrangement, ui::PlotArrangement::kTwo);
}

TEST_F(TourTest, TheFirstSceneRepeatsUntilSomebodyTakesPart) {
  state().scene.repeats = true;
  live(static_cast<int>(scene().tick_count()) + 20);
  EXPECT_EQ(fake_->resets, 1);
  state().hand.led = true;
  live(static_cast<int>(scene().tick_count()) + 20);
  EXPECT_EQ(fake_->resets, 1) << "the pointer leads the hand";
  open("tap");
  click("repeat scene");
  EXPECT_TRUE(state().scene.repeats);
  click("begin tour");
  EXPECT_FALSE(state().scene.repeats) << "another scene was chosen";
}

}  // namespace
}  // namespace hapticwall::test
