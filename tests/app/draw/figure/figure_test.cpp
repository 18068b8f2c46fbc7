#include "app/draw/figure/figure.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/draw/figure/page_texts.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

struct PressRun {
  Scene scene;
  std::vector<Sample> samples;
};

PressRun run_press(const char* algorithm) {
  PressRun run;
  run.scene = file::load_scene("press")->scene;
  run.scene.algorithm.index = *find_algorithm(algorithm);
  run.scene.duration_s = 3.0;
  run.samples = testing::samples_of(run.scene);
  return run;
}

// Hides the display for the lifetime of the object.
class NoDisplay {
 public:
  NoDisplay() {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
      const char* value = std::getenv(name);
      saved_.emplace_back(name, value != nullptr ? value : "");
      unsetenv(name);
    }
  }
  NoDisplay(const NoDisplay&) = delete;
  NoDisplay& operator=(const NoDisplay&) = delete;
  ~NoDisplay() {
    for (const auto& [name, value] : saved_) {
      if (!value.empty()) setenv(name.c_str(), value.c_str(), 1);
    }
  }

 private:
  std::vector<std::pair<std::string, std::string>> saved_;
};

// The four plots stand below each other, each below its mark; each line's colour is in its own
// plot, below the legend. `texts`: the same figure as shapes.
void expect_lines_of_four_plots(const file::Picture& figure, const file::Picture& texts) {
  ASSERT_NEAR(figure.width, 2102, 1) << "178 mm at 300 dpi";
  ASSERT_NEAR(figure.height, texts.height, 1);
  ASSERT_EQ(figure.rgba.size(), 4U * static_cast<std::size_t>(figure.width * figure.height));

  constexpr int kEnoughPixels = 80;
  const std::array tops{test::find_text(texts, "(a)").ink, test::find_text(texts, "(b)").ink,
                        test::find_text(texts, "(c)").ink, test::find_text(texts, "(d)").ink};
  const auto count = [&](Tone tone, std::size_t row) {
    const ImVec4 colour = theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)];
    const int top = static_cast<int>(tops.at(row).y + 1.5 * tops.at(row).height);
    const int bottom = row == 3 ? figure.height : static_cast<int>(tops.at(row + 1).y);
    return test::count_pixels(figure, test::colour_of(colour), 0, top, figure.width, bottom);
  };
  EXPECT_GT(count(Tone::kPosition, 0), kEnoughPixels);
  EXPECT_GT(count(Tone::kHand, 0), kEnoughPixels);
  EXPECT_GT(count(Tone::kWall, 0), kEnoughPixels);
  EXPECT_GT(count(Tone::kForce, 1), kEnoughPixels);
  EXPECT_GT(count(Tone::kWallForce, 1), kEnoughPixels);
  EXPECT_GT(count(Tone::kStiffness, 2), kEnoughPixels);
  EXPECT_GT(count(Tone::kObserver, 3), kEnoughPixels);
  EXPECT_GT(count(Tone::kHold, 3), kEnoughPixels);
  EXPECT_GT(count(Tone::kScv, 3), kEnoughPixels);
  EXPECT_GT(count(Tone::kBudget, 3), kEnoughPixels);
  EXPECT_LT(count(Tone::kHold, 0), kEnoughPixels);  // the colours do tell the plots apart
}

TEST(Figure, ShowsTheLinesOfAllFourPlotsWithoutADisplay) {
  const NoDisplay no_display;
  const PressRun run = run_press("none");
  const Result<file::Picture> figure = draw_figure(run.scene, run.samples);
  ASSERT_TRUE(figure.ok()) << figure.error().message;
  expect_lines_of_four_plots(*figure,
                             *draw_figure(run.scene, run.samples, Paper{}.in(Ink::kShapes)));
}

TEST(Figure, ShowsTheLinesOfAllFourPlotsInVectorFiles) {
  if (!test::can_draw_vector_files()) GTEST_SKIP() << test::kNoPrograms;
  const PressRun run = run_press("none");
  const auto draw = [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); };
  for (const char* ending : {".svg", ".pdf"})
    expect_lines_of_four_plots(test::FigureFile(draw, ending).drawn(), *draw(Ink::kShapes));
}

TEST(Figure, IsTheSameEveryTimeAndDependsOnTheRun) {
  const PressRun none = run_press("none");
  const PressRun bounded = run_press("energy-bounding");
  constexpr Paper kSize{kSingleWidthMm};
  const auto first = draw_figure(none.scene, none.samples, kSize);
  const auto second = draw_figure(none.scene, none.samples, kSize);
  const auto other = draw_figure(bounded.scene, bounded.samples, kSize);
  ASSERT_TRUE(first.ok() && second.ok() && other.ok());
  EXPECT_EQ(first->rgba, second->rgba);
  EXPECT_NE(first->rgba, other->rgba);
}

TEST(Figure, APageWithoutSamplesIsDrawn) {
  const auto figure = draw_figure(file::load_scene("press")->scene, {});
  ASSERT_TRUE(figure.ok());
  const int white =
      test::count_pixels(*figure, {255, 255, 255}, 0, 0, figure->width, figure->height);
  EXPECT_GT(white, figure->width * figure->height / 2);
}

TEST(Figure, RefusesAWidthThatIsNone) {
  for (const double width_mm : {0.0, -1.0, 79.0, 421.0, std::nan("")}) {
    const auto figure = draw_figure(file::load_scene("press")->scene, {}, {width_mm});
    ASSERT_FALSE(figure.ok()) << width_mm;
    EXPECT_NE(figure.error().message.find("80 to 420"), std::string::npos);
  }
}

TEST(Figure, GoesIntoAPngOfItsSize) {
  const PressRun run = run_press("virtual-coupling");
  const auto figure = draw_figure(run.scene, run.samples, {kSingleWidthMm});
  ASSERT_TRUE(figure.ok());
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) / "hapticwall_figure_test.png";
  ASSERT_FALSE(file::write_png(path, *figure));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0);
  EXPECT_EQ(image.width, 1016U) << "86 mm at 300 dpi";
  EXPECT_EQ(image.height, static_cast<unsigned>(figure->height));
  png_image_free(&image);
  std::filesystem::remove(path);
}

TEST(Figure, IsTheSameInVectorFiles) {
  const PressRun run = run_press("energy-bounding");
  test::expect_same_in_vector_files(
      [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); });
}

// Two figures stand in one file, like those of both axes of a scene.
TEST(Figure, TwoOfThemStandBesideOrBelowEachOtherInVectorFiles) {
  const PressRun none = run_press("none");
  const PressRun bounded = run_press("energy-bounding");
  test::expect_same_in_vector_files([&](Ink ink) -> Result<file::Picture> {
    const Paper size{kSingleWidthMm, ink};
    const auto left = draw_figure(none.scene, none.samples, size);
    const auto right = draw_figure(bounded.scene, bounded.samples, size);
    if (!left || !right) return left ? right : left;
    return file::beside(*left, *right);
  });
  test::expect_same_in_vector_files([&](Ink ink) -> Result<file::Picture> {
    const auto upper = draw_figure(none.scene, none.samples, {kSingleWidthMm, ink});
    const auto lower = draw_figure(bounded.scene, bounded.samples, {100.0, ink});
    if (!upper || !lower) return upper ? lower : upper;
    return file::below(*upper, *lower);
  });
}

TEST(Figure, VectorFilesAreSmallAndHoldNoPixels) {
  constexpr std::size_t kMaxBytes = 500'000;
  const PressRun run = run_press("none");
  for (const char* ending : {".svg", ".pdf"}) {
    const test::FigureFile figure(
        [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); }, ending);
    EXPECT_LT(figure.bytes().size(), kMaxBytes) << ending;
    EXPECT_EQ(figure.bytes().find("<image"), std::string::npos) << ending;
    EXPECT_EQ(figure.bytes().find("/CreationDate"), std::string::npos) << ending;
    EXPECT_EQ(figure.bytes().find("/Subtype /Image"), std::string::npos) << ending;
  }
}

TEST(Figure, ItsTextStaysTextInAPdf) {
  if (std::system("command -v pdftotext >/dev/null") != 0) GTEST_SKIP() << "there is no pdftotext";
  const PressRun run = run_press("none");
  const test::FigureFile pdf(
      [&](Ink ink) { return draw_figure(run.scene, run.samples, {.ink = ink}); }, ".pdf");
  const std::string text = pdf.passed_through("f() { pdftotext \"$1\" -; }; f");
  for (const char* words : {"handle 50 g, 1 N·s/m", "force F (N)", "force / penetration"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

// A print shop takes the size of the page, and sees no fonts of the machine.
TEST(Figure, APdfHasTheSizeOfThePaperAndInterAlone) {
  if (std::system("command -v pdffonts >/dev/null") != 0) GTEST_SKIP() << "there is no pdffonts";
  const PressRun run = run_press("none");
  const test::FigureFile pdf(
      [&](Ink ink) {
        return draw_figure(run.scene, run.samples, {kSingleWidthMm, ink});
      },
      ".pdf");
  const std::string info = pdf.passed_through("pdfinfo");
  EXPECT_NE(info.find("Page size:       243.84 x"), std::string::npos) << "86 mm\n" << info;
  const std::string fonts = pdf.passed_through("pdffonts");
  EXPECT_NE(fonts.find("Inter"), std::string::npos) << fonts;
  EXPECT_EQ(fonts.find("Mono"), std::string::npos) << fonts;
}

}  // namespace
}  // namespace hapticwall::draw
