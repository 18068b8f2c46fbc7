#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/ui/panel/wall_view.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/app/ui/gui_test.h"
#include "tests/app/ui/pixels.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::MessageKind;

class ApplicationTest : public GuiTest {
 protected:
  [[nodiscard]] std::string_view algorithm() const {
    return algorithms()[fake_->scene().algorithm.index].name;
  }
};

TEST_F(ApplicationTest, PauseStepAndResetByButtonAndByKey) {
  click("step");  // does nothing while it runs
  EXPECT_EQ(fake_->steps, 0);
  click("pause");
  EXPECT_TRUE(fake_->is_paused);
  click("step");
  EXPECT_EQ(fake_->steps, 1);
  press(ImGuiKey_S);
  press(ImGuiKey_RightArrow);
  EXPECT_EQ(fake_->steps, 3);
  press(ImGuiKey_P);
  EXPECT_FALSE(fake_->is_paused);
  click("reset");
  press(ImGuiKey_R);
  EXPECT_EQ(fake_->resets, 2);
}

TEST_F(ApplicationTest, ASceneFromElsewhereNamesNoOtherFolder) {
  for (const std::string& name :
       {std::string("../../x"), std::string("/etc/x"), std::string("a\0b", 3),
        std::string("\x1b[2J"), std::string(300, 'n'), std::string(".")}) {
    Scene scene = fake_->scene();
    scene.name = name;
    application_->state().transient.wanted_scene = ui::WantedScene{scene, true};
    frames(2);
    ASSERT_EQ(fake_->scene().name, name);
    click("record");
    const std::string path = fake_->recording_status().path;
    EXPECT_EQ(path.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789J_-."), std::string::npos)
        << path;
    EXPECT_FALSE(path.starts_with('.')) << path;
    EXPECT_LT(path.size(), 255U);
    click("record");
  }
}

TEST_F(ApplicationTest, ARecordingThatCannotBeSaysWhy) {
  fake_->refuse_recording = "the disk is full";
  click("record");
  EXPECT_EQ(message().kind, MessageKind::kProblem);
  EXPECT_EQ(message().text, "the disk is full");
  click("message");
  EXPECT_EQ(message().kind, MessageKind::kNone);
}

TEST_F(ApplicationTest, TheStiffnessSliderIsLogarithmic) {
  const ItemRect slider = rect("stiffness-slider");
  move_to(slider.centre());
  mouse_button(true);
  mouse_button(false);
  // The middle between 100 N/m and 1 MN/m.
  EXPECT_NEAR(std::log10(fake_->scene().x().walls[0].stiffness_n_per_m), 4.0, 0.1);
}

TEST_F(ApplicationTest, AnInvalidValueIsExplainedAndTheOldOneStays) {
  type("stiffness", "-5");
  EXPECT_EQ(message().kind, MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("stiffness_n_per_m"));
  EXPECT_DOUBLE_EQ(fake_->scene().x().walls[0].stiffness_n_per_m, 35000.0);
  type("stiffness", "stiff");
  EXPECT_THAT(message().text, HasSubstr("'stiff' is not a number"));
  EXPECT_DOUBLE_EQ(fake_->scene().x().walls[0].stiffness_n_per_m, 35000.0);
}

TEST_F(ApplicationTest, ANewRateStartsANewSessionAtRestAndABadOneDoesNot) {
  live(500);
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  EXPECT_DOUBLE_EQ(fake_->scene().sampling.rate_hz, 2000.0);
  EXPECT_EQ(fake_->snapshot().newest.x().tick, 0U);
  EXPECT_TRUE(application_->history().empty());
  type("rate", "-1");
  EXPECT_EQ(sessions, 2);
  EXPECT_THAT(message().text, HasSubstr("rate_hz"));
  EXPECT_DOUBLE_EQ(fake_->scene().sampling.rate_hz, 2000.0);
}

TEST_F(ApplicationTest, TheIntegratorIsChosenAndItsSubstepsTyped) {
  live(300);
  click("integrator");
  click("semi-implicit-euler");
  EXPECT_EQ(fake_->scene().simulator.integrator, Integrator::kSemiImplicitEuler);
  type("substeps", "20");
  EXPECT_EQ(fake_->scene().simulator.substeps, 20);
  type("substeps", "1e9");
  EXPECT_EQ(fake_->scene().simulator.substeps, 20);
  ASSERT_TRUE(refusal().has_value());
  EXPECT_THAT(refusal()->why, HasSubstr("1 to 1000"));
  type("substeps", "2.5");
  EXPECT_EQ(fake_->scene().simulator.substeps, 20);
  EXPECT_THAT(refusal()->why, HasSubstr("no whole number"));
  click("integrator");
  click("rk4");
  EXPECT_EQ(fake_->scene().simulator.substeps, 20) << "it takes as many";
  EXPECT_FALSE(refusal().has_value());
  click("integrator");
  click("exact");
  EXPECT_EQ(fake_->scene().simulator, SimulatorSettings{});
  live(100);
  EXPECT_EQ(sessions, 1) << "it all happened while it ran";
  EXPECT_EQ(application_->history().size(), 400U);
}

TEST_F(ApplicationTest, ASessionThatDoesNotStartLeavesTheOldOne) {
  refuse_session = "no loop to be had";
  type("rate", "2000");
  EXPECT_EQ(message().text, "no loop to be had");
  EXPECT_DOUBLE_EQ(application_->session().scene().sampling.rate_hz, 1000.0);
}

TEST_F(ApplicationTest, TheHandsScriptIsChangedByTyping) {
  click("section Hand");
  type("end position", "70");
  EXPECT_EQ(sessions, 2);
  EXPECT_DOUBLE_EQ(fake_->scene().x().hand->path.back().position_m, 0.07);
  type("approach speed", "20");
  EXPECT_EQ(sessions, 3);
  EXPECT_NEAR(fake_->scene().x().hand->path.back().time_s, 2.0, 1e-12);  // 40 mm at 20 mm/s
  type("approach speed", "0");
  EXPECT_EQ(sessions, 3);
  EXPECT_THAT(message().text, HasSubstr("approach speed"));
}

TEST_F(ApplicationTest, TheFigureButtonsStartPressFromRestUnderThePapersAlgorithms) {
  struct Case {
    const char* button;
    const char* algorithm;
    const char* shown;
    const char* not_shown;
  };
  for (const Case& figure :
       {Case{"Figure 4", "none", "plot Passivity", "plot Stiffness"},
        Case{"Figure 5", "virtual-coupling", "plot Stiffness", "plot Passivity"},
        Case{"Figure 6", "energy-bounding", "plot Stiffness", "plot Passivity"}}) {
    live(300);
    const int before = sessions;
    click(figure.button);
    frames(2);
    EXPECT_EQ(sessions, before + 1);
    EXPECT_EQ(fake_->scene().name, "press");
    EXPECT_EQ(algorithm(), figure.algorithm);
    EXPECT_EQ(fake_->snapshot().newest.x().tick, 0U);
    EXPECT_TRUE(find(figure.shown).has_value());
    EXPECT_FALSE(find(figure.not_shown).has_value());
  }
}

TEST_F(ApplicationTest, DraggingInTheViewLeadsTheHandAndLettingGoReturnsToTheScript) {
  const ItemRect view = rect("wall view");
  const ui::WallCamera camera = ui::wall_view_camera(
      fake_->scene(), ImVec2(view.to.x - view.from.x, view.to.y - view.from.y));
  const auto place = [&](double position_m) {
    const glm::vec2 pixel = camera.pixel_of({camera.x_of(position_m), 0.0F, 0.0F});
    return ImVec2(view.from.x + pixel.x, view.from.y + pixel.y);
  };
  move_to(place(0.04));
  mouse_button(true);
  ASSERT_TRUE(fake_->lead.has_value());
  EXPECT_NEAR(*fake_->lead, 0.04, 1e-4);
  move_to(place(0.045));
  EXPECT_NEAR(*fake_->lead, 0.045, 1e-4);
  live(2000);
  EXPECT_NEAR(fake_->snapshot().newest.x().truth.position_m, 0.045,
              1.5e-3);  // friction holds it back
  mouse_button(false);
  EXPECT_FALSE(fake_->lead.has_value());

  application_->state().persisted.hand_stays_where_released = true;
  mouse_button(true);
  mouse_button(false);
  EXPECT_TRUE(fake_->lead.has_value());
}

TEST_F(ApplicationTest, ThePlotsFollowTheNewestSamplesUntilTheUserScrolls) {
  live(8000);
  EXPECT_DOUBLE_EQ(application_->state().transient.time_to_s,
                   application_->history().newest_time_s());
  EXPECT_NEAR(
      application_->state().transient.time_to_s - application_->state().transient.time_from_s, 6.0,
      1e-9);
  move_to(rect("plot Force").centre());
  ImGui::GetIO().AddMouseWheelEvent(0.0F, 2.0F);
  frames(3);
  EXPECT_FALSE(application_->state().transient.follow);
  const double looked_at_s = application_->state().transient.time_to_s;
  live(1000);
  EXPECT_DOUBLE_EQ(application_->state().transient.time_to_s, looked_at_s);
  click("follow");
  live(100);
  EXPECT_DOUBLE_EQ(application_->state().transient.time_to_s,
                   application_->history().newest_time_s());
}

TEST_F(ApplicationTest, EverySampleOfTheSessionReachesTheHistory) {
  fake_->advance(20000);
  frames(1);
  ASSERT_EQ(application_->history().size(), 20000U);
  click("reset");
  fake_->advance(10);
  frames(1);
  EXPECT_EQ(application_->history().size(), 10U);
}

TEST_F(ApplicationTest, TheScreenShowsTheLinesOfEveryPlot) {
  press(ImGuiKey_1);
  live(3000);
  move_to(ImVec2(2.0F, 2.0F));
  const file::Picture picture = screen();
  const auto count = [&](const char* plot, draw::Tone tone) {
    const ItemRect area = rect(plot);
    const ImVec4 colour = draw::theme_colours(draw::Look::kScreen)[static_cast<std::size_t>(tone)];
    return count_pixels(picture, colour_of(colour), static_cast<int>(area.from.x),
                        static_cast<int>(area.from.y), static_cast<int>(area.to.x),
                        static_cast<int>(area.to.y));
  };
  constexpr int kEnoughPixels = 100;
  EXPECT_GT(count("plot Position", draw::Tone::kPosition), kEnoughPixels);
  EXPECT_GT(count("plot Force", draw::Tone::kForce), kEnoughPixels);
  EXPECT_GT(count("plot Stiffness", draw::Tone::kStiffness), kEnoughPixels);
  EXPECT_GT(count("plot Passivity", draw::Tone::kObserver), kEnoughPixels);
}

// Everything fits into the smallest supported window.
TEST_F(ApplicationTest, EverythingFitsIntoTheWindow) {
  live(1000);
  for (const auto& [name, item] : drawn_items()) {
    if (item.id == 0) continue;
    EXPECT_GE(item.from.x, 0.0F) << name;
    EXPECT_GE(item.from.y, 0.0F) << name;
    EXPECT_LE(item.to.x, static_cast<float>(kScreenWidth)) << name;
    EXPECT_LE(item.to.y, static_cast<float>(kScreenHeight)) << name;
  }
}

}  // namespace
}  // namespace hapticwall::test
