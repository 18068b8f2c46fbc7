// The two export buttons, on the real disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <future>
#include <string>
#include <vector>

#include "app/draw/figure/figure.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;

class PlotExportTest : public GuiTest {
 protected:
  void SetUp() override {
    GuiTest::SetUp();
    state().recording.folder = path("");
  }

  [[nodiscard]] std::vector<std::string> files(const std::string& ending) const {
    return folder_.names(ending);
  }
  void export_csv() {
    click("export csv");
    frames_until([&] { return !state().plots.transient.exporting.running(); });
  }
};

TEST_F(PlotExportTest, TheVisibleSamplesGoIntoACsvOfTheirOwnEachTime) {
  press(ImGuiKey_1);
  live(8000);
  click("follow");
  export_csv();
  const std::vector<std::string> first = files(".csv");
  ASSERT_EQ(first.size(), 1U);
  EXPECT_THAT(first[0], HasSubstr("press-none-"));
  EXPECT_EQ(lines_of(path(first[0])).size(), 1U + 6001U);
  ASSERT_EQ(files(".toml").size(), 1U);
  EXPECT_THAT(content(files(".toml")[0]), HasSubstr("first_tick = 1999"));
  EXPECT_EQ(message().kind, ui::MessageKind::kNote);
  EXPECT_THAT(message().text, HasSubstr(first[0]));
  EXPECT_THAT(message().text, HasSubstr("6001 rows"));
  export_csv();
  EXPECT_EQ(files(".csv").size(), 2U) << "nothing is overwritten";
}

TEST_F(PlotExportTest, WithoutSamplesInTheWindowNothingIsWritten) {
  live(500);
  click("follow");
  state().time.from_s = 50.0;
  state().time.to_s = 56.0;
  export_csv();
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("no sample"));
  EXPECT_TRUE(folder_.names().empty());
}

TEST_F(PlotExportTest, AFolderThatIsNotThereIsTold) {
  live(500);
  state().recording.folder = path("nowhere");
  export_csv();
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("nowhere"));
  click("export png");
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("nowhere"));
}

TEST_F(PlotExportTest, TheFigureGoesIntoAPngAndTheWindowGoesOn) {
  press(ImGuiKey_1);
  live(3000);
  for (int i = 0; i < 2; ++i) {
    click("export png");
    ASSERT_EQ(files(".png").size(), static_cast<std::size_t>(i + 1)) << message().text;
    EXPECT_THAT(message().text, HasSubstr(".png"));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, path(files(".png")[0]).c_str()), 0);
  EXPECT_EQ(image.width, 2102U) << "178 mm at 300 dpi";
  png_image_free(&image);
  // The OpenGL context of the window still paints.
  live(100);
  move_away();
  EXPECT_GT(count_tone(screen(), draw::Tone::kForce, rect("plot Force")), 100);
}

// The figure shows the visible range, plots, signals and value axes.
TEST_F(PlotExportTest, AFigureShowsTheVisibleRangeThePlotsAndTheSignalsThatAreAskedFor) {
  live(3000);
  constexpr std::array kForceOnly{draw::PlotId::kForce};
  const auto count = [&](const draw::FigureView& view, draw::Tone tone) {
    // The figure is drawn on another thread, because it has an OpenGL context of its own.
    const auto figure = std::async(std::launch::async, [&] {
                          return draw::draw_figure(scene(), application_->history(), view);
                        }).get();
    EXPECT_TRUE(figure.ok());
    if (!figure) return 0;
    const ImVec2 end(static_cast<float>(figure->width), static_cast<float>(figure->height));
    const ItemRect below_legend{ImVec2(0.0F, 170.0F), end};
    return count_tone(*figure, tone, below_legend, draw::Look::kPrint);
  };
  draw::FigureView view;
  view.window = {0.0, 3.0};
  view.plots = kForceOnly;
  EXPECT_GT(count(view, draw::Tone::kForce), 100);
  EXPECT_EQ(count(view, draw::Tone::kPosition), 0);
  EXPECT_EQ(count(view, draw::Tone::kHand), 0);
  view.lines[static_cast<std::size_t>(draw::PlotId::kForce)] |=
      draw::line_bit(&PlantTruth::hand_force_n);
  EXPECT_GT(count(view, draw::Tone::kHand), 100);
  view.hidden = draw::line_bit(&Sample::force_n);
  EXPECT_LT(count(view, draw::Tone::kForce), 20);
  view.hidden = 0;
  view.window = {10.0, 13.0};  // nothing is there
  EXPECT_LT(count(view, draw::Tone::kForce), 20);
  view.window = {0.0, 3.0};
  view.axes[static_cast<std::size_t>(draw::PlotId::kForce)].left = {true, 100.0, 200.0};
  EXPECT_LT(count(view, draw::Tone::kForce), 20) << "beyond the axis that the user has put";
  view.axes = {};
  view.plots = {};
  view.phase.shown = true;
  EXPECT_GT(count(view, draw::Tone::kForce), 100) << "the plane alone";
}

}  // namespace
}  // namespace hapticwall::test
