// Plays the tour as README.md tells it, and finds its claims on the verdict strip.
#include "app/ui/state/tour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include "app/ui/panel/tour_strip.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"
#include "tests/paths.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::TourStep;

constexpr int kLongEnough = 6000;  // ticks
constexpr std::size_t kLessons = 5;

class TourTest : public GuiTest {
 protected:
  TourTest() { shows_everything = false; }

  void press_key(char key) {
    press(key == 'R' ? ImGuiKey_R : static_cast<ImGuiKey>(ImGuiKey_0 + (key - '0')));
    live(kLongEnough);
  }
  // The same with the pointer: a chip of the first window, a row of the list, or the button of R.
  void click_key(char key) {
    click(key == 'R' ? "reset"
                     : std::string(algorithms()[static_cast<std::size_t>(key - '1')].name));
    live(kLongEnough);
  }

  // "Press 1 until the wall chatters, then 4." is "14".
  static std::string keys_of(const std::string& text) {
    static const std::regex kKey("(?:Press|then) ([1-9R])\\b");
    std::string keys;
    for (std::sregex_iterator key(text.begin(), text.end(), kKey); key != std::sregex_iterator();
         ++key)
      keys += (*key)[1].str();
    return keys;
  }
  // The parts of a text that begin with "Press".
  static std::vector<std::string> parts_of(const TourStep& step) {
    static const std::regex kPart("Press .*?(?= Press |$)");
    const std::string text(step.text);
    std::vector<std::string> parts;
    for (std::sregex_iterator part(text.begin(), text.end(), kPart); part != std::sregex_iterator();
         ++part)
      parts.push_back(part->str());
    return parts;
  }
  // Presses the keys of every lesson, and finds each seen only after its last key.
  void play(const std::function<void(char)>& use) {
    for (std::size_t i = 0; i < kLessons; ++i) {
      const TourStep& step = ui::tour_steps()[i];
      SCOPED_TRACE(step.text);
      EXPECT_EQ(state().tour.step, i + 1);
      for (const std::string& part : parts_of(step)) {
        EXPECT_FALSE(ui::step_seen(state().tour));
        EXPECT_TRUE(sees("· not seen yet"));
        std::ranges::for_each(keys_of(part), use);
        frames(2);
        expect_claims(part);
      }
      EXPECT_TRUE(sees("· seen")) << draw::tail_text(state().tails.front());
      click("tour next");
    }
    EXPECT_TRUE(sees("What next"));
    EXPECT_FALSE(sees("· seen"));
  }
  [[nodiscard]] ui::TourState& tour() const { return state().tour; }
  void begin_step(std::size_t step) {
    click("begin tour");
    live(kLongEnough);
    ui::go_to_step(tour(), step);
    frames(2);
  }
  // Share of the dots of the frame around an item, 3 pixels outside of it, that have its colour.
  [[nodiscard]] double framed(const std::string& item, ImVec2 gap = {3.0F, 3.0F}) {
    move_away();
    const file::Picture picture = screen();
    const ItemRect inner = rect(item);
    const ItemRect ring{ImVec2(inner.from.x - gap.x, inner.from.y - gap.y),
                        ImVec2(inner.to.x + gap.x, inner.to.y + gap.y)};
    const auto top = static_cast<float>(count_tone(picture, draw::Tone::kAccent,
                                                   {ImVec2(ring.from.x + 6.0F, ring.from.y - 2.0F),
                                                    ImVec2(ring.to.x - 6.0F, ring.from.y + 2.0F)},
                                                   draw::Look::kScreen, 60));
    const auto bottom = static_cast<float>(count_tone(
        picture, draw::Tone::kAccent,
        {ImVec2(ring.from.x + 6.0F, ring.to.y - 2.0F), ImVec2(ring.to.x - 6.0F, ring.to.y + 2.0F)},
        draw::Look::kScreen, 60));
    return static_cast<double>(std::min(top, bottom) / (ring.to.x - ring.from.x - 12.0F));
  }
  [[nodiscard]] bool is_framed(const std::string& item) { return framed(item) > 0.8; }

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

TEST_F(TourTest, EveryLessonIsSeenByItsKeysAsItsTextSays) {
  click("begin tour");
  EXPECT_EQ(scene().name, ui::kTourScene);
  play([this](char key) { press_key(key); });
  click("close tour");
  EXPECT_FALSE(sees("What next"));
  EXPECT_EQ(tour().step, 0U);
}

TEST_F(TourTest, EveryLessonIsSeenByTheChipsOfTheFirstWindow) {
  live(200);
  ASSERT_TRUE(sees("lead B")) << "the first window";
  click("begin tour");
  play([this](char key) { click_key(key); });
}

TEST_F(TourTest, EveryLessonIsSeenByTheListAfterMore) {
  click("more");
  click("help");
  click("tour of help");
  ASSERT_TRUE(sees("page Map")) << "the docked window";
  play([this](char key) { click_key(key); });
}

TEST_F(TourTest, TheFirstLessonWaitsForItsKeyAlthoughTheWallChatters) {
  click("begin tour");
  live(kLongEnough);
  EXPECT_THAT(draw::tail_text(state().tails.front()), HasSubstr("oscillating"));
  EXPECT_TRUE(sees("· not seen yet"));
  press(ImGuiKey_R);
  live(kLongEnough);
  EXPECT_TRUE(sees("· not seen yet"));
  press_key('1');
  EXPECT_TRUE(sees("· seen"));
}

// Energy bounding is quiet before R as well, when the session began under it.
TEST_F(TourTest, ALessonFromRestWaitsForTheNewSession) {
  begin_step(4);
  press_key('4');
  press_key('R');
  tour().seen.reset();
  ui::go_to_step(tour(), 4);
  press_key('4');
  EXPECT_THAT(draw::tail_text(state().tails.front()), HasSubstr("settled"));
  EXPECT_FALSE(ui::step_seen(tour()));
  press(ImGuiKey_R);
  EXPECT_FALSE(ui::step_seen(tour())) << "the verdict is that before R";
  live(kLongEnough);
  EXPECT_TRUE(ui::step_seen(tour()));
}

TEST_F(TourTest, TwoAttractorsNeedTheCycleBeforeTheQuiet) {
  begin_step(5);
  press_key('4');
  press_key('R');
  EXPECT_THAT(draw::tail_text(state().tails.front()), HasSubstr("settled"));
  EXPECT_FALSE(ui::step_seen(tour()));
  press_key('1');
  EXPECT_EQ(tour().move, 1U);
  press_key('3');
  EXPECT_EQ(tour().move, 0U) << "another algorithm begins it anew";
  press_key('1');
  press_key('4');
  EXPECT_EQ(tour().move, 2U);
  press_key('R');
  EXPECT_TRUE(ui::step_seen(tour()));
}

TEST_F(TourTest, TheEndComesAfterTheLastLessonWasSeen) {
  begin_step(kLessons);
  click("tour next");
  EXPECT_EQ(tour().step, kLessons);
  for (const char key : std::string("14R")) press_key(key);
  click("tour next");
  EXPECT_EQ(tour().step, kLessons + 1);
  click("tour back");
  EXPECT_TRUE(sees("· seen")) << "it stays seen";
}

TEST_F(TourTest, ItBeginsFromAnotherSceneOfTheFirstWindow) {
  open("tap");
  click("begin tour");
  EXPECT_EQ(scene().name, ui::kTourScene);
  EXPECT_EQ(tour().step, 1U);
}

TEST_F(TourTest, AFrameStandsAroundTheKeyUntilItIsPressed) {
  begin_step(3);
  EXPECT_TRUE(is_framed("virtual-coupling")) << framed("virtual-coupling");
  for (const char* other : {"energy-bounding", "reset"}) EXPECT_FALSE(is_framed(other)) << other;
  press_key('2');
  EXPECT_FALSE(is_framed("virtual-coupling"));
  EXPECT_TRUE(is_framed("reset")) << framed("reset");
  press_key('R');
  EXPECT_FALSE(is_framed("reset")) << "the lesson is seen";
}

TEST_F(TourTest, AFrameStandsAroundThePlacesOfTheText) {
  begin_step(2);
  press_key('3');
  EXPECT_TRUE(is_framed("The hold has fed the hand…"));
  EXPECT_GT(framed("oscillating", ImVec2(5.0F, 0.0F)), 0.8);
  EXPECT_FALSE(is_framed("more"));
  ui::go_to_step(tour(), kLessons + 1);
  frames(2);
  EXPECT_TRUE(is_framed("wall view"));
  EXPECT_TRUE(is_framed("more"));
  EXPECT_FALSE(is_framed("The hold has fed the hand…"));
  click("close tour");
  EXPECT_FALSE(is_framed("wall view"));
}

TEST_F(TourTest, AfterMoreTheFramesStandInTheListAndTheRows) {
  click("more");
  click("help");
  click("tour of help");
  live(kLongEnough);
  EXPECT_TRUE(is_framed("none"));
  press_key('1');
  EXPECT_FALSE(is_framed("none"));
  EXPECT_GT(framed("oscillating", ImVec2(5.0F, 0.0F)), 0.8);
  ui::go_to_step(tour(), 3);
  press_key('2');
  EXPECT_TRUE(is_framed("reset"));
}

TEST_F(TourTest, AnotherSceneLeavesIt) {
  click("begin tour");
  EXPECT_EQ(state().tour.step, 1U);
  click("more");
  click("scene");
  click("scene tap");
  EXPECT_EQ(scene().name, "tap");
  EXPECT_EQ(state().tour.step, 0U);
}

TEST_F(TourTest, TheReadmeTellsTheSame) {
  std::string readme = text_of(data_folder() + "/../README.md");
  readme = std::regex_replace(readme, std::regex("\\s+"), " ");
  for (const TourStep& step : ui::tour_steps().first(kLessons)) {
    EXPECT_THAT(readme, HasSubstr(std::string(step.text)));
    EXPECT_THAT(readme, HasSubstr("**" + std::string(step.lesson) + ".**"));
  }
}

TEST_F(TourTest, ANewcomerSeesTheWallTwoPlotsAndTheAlgorithmsAndMoreOpensTheRest) {
  for (const char* item :
       {"runs Position", "runs Force", "wall view", "none", "more", "begin tour"})
    EXPECT_TRUE(sees(item)) << item;
  for (const char* item : {"plot Stiffness", "magnifier", "damping", "page Map", "freeze"})
    EXPECT_FALSE(sees(item)) << item;
  click("more");
  for (const char* item : {"plot Stiffness", "magnifier", "damping", "page Map"})
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
  state().scene.repeats = true;
  frames(2);
  click("begin tour");
  EXPECT_FALSE(state().scene.repeats) << "another scene was chosen";
}

}  // namespace
}  // namespace hapticwall::test
