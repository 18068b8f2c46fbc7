// The figure of a map, by its pixels: cells where they belong, bounds over them.
#include "app/draw/figure/map_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/draw/figure/map_field.h"
#include "app/draw/figure/verdict_colours.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"

namespace hapticwall::draw {
namespace {

StabilityMap map_of(std::size_t algorithm_count) {
  StabilityMap map;
  map.scene = file::load_scene("press")->scene;
  for (std::size_t i = 0; i < algorithm_count; ++i) map.algorithms.push_back(i);
  map.x = {find_scene_number(map.scene, "wall.stiffness_n_per_m").value(), 1e3, 1e5, 40, true};
  map.y = {find_scene_number(map.scene, "device.damping_n_s_per_m").value(), 0.5, 5.0, 30, false};
  return map;
}

// The right half settles, the left swings by 10 mm.
std::vector<MapMetrics> half_and_half(const StabilityMap& map) {
  std::vector<MapMetrics> figures(map.cell_count());
  for (std::size_t cell = 0; cell < figures.size(); ++cell) {
    const bool settled = map.place(cell).x >= map.x.count / 2;
    figures[cell].verdict = settled ? Verdict::kSettled : Verdict::kOscillating;
    figures[cell].tail_peak_to_peak_m = settled ? 0.0 : 0.01;
  }
  return figures;
}

constexpr int kLegend = 330;  // pixels of the heading at double width, at most

struct Extent {
  std::size_t count = 0;
  int left = 1 << 20;
  int right = -1;
};

// The pixels of a colour below the legend: in the fields, which follow "bounds of the bare wall".
Extent extent_of(const file::Picture& picture, ImU32 colour, int legend = kLegend) {
  Extent extent;
  for (int y = legend; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* pixel =
          &picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x))];
      if (IM_COL32(pixel[0], pixel[1], pixel[2], 255) != colour) continue;
      ++extent.count;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
    }
  }
  return extent;
}

TEST(MapFigure, CellsStandWhereTheirValuesAre) {
  const StabilityMap map = map_of(1);
  const auto picture = draw_map(map, half_and_half(map));
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const Extent settled = extent_of(*picture, verdict_area(Verdict::kSettled));
  const Extent swinging = extent_of(*picture, oscillating_colour(0.01));
  // Nearly the whole field, in equal halves; the bounds take a few pixels.
  const auto below = static_cast<std::size_t>(picture->width * (picture->height - kLegend));
  EXPECT_GT(settled.count + swinging.count, below * 7U / 10U);
  EXPECT_NEAR(static_cast<double>(settled.count) / static_cast<double>(swinging.count), 1.0, 0.02);
  EXPECT_LT(swinging.right, settled.left + 3);
  EXPECT_NEAR(settled.right - settled.left, swinging.right - swinging.left, 3);
}

TEST(MapFigure, EveryAlgorithmHasAField) {
  const StabilityMap map = map_of(8);
  std::vector<MapMetrics> figures(map.cell_count());
  // Only the sixth diverges.
  const std::size_t cells = map.x.count * map.y.count;
  for (std::size_t i = 0; i < cells; ++i) figures[5 * cells + i].verdict = Verdict::kDiverged;
  const auto picture = draw_map(map, figures);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const Extent diverged = extent_of(*picture, verdict_area(Verdict::kDiverged));
  const Extent settled = extent_of(*picture, verdict_area(Verdict::kSettled));
  EXPECT_NEAR(static_cast<double>(settled.count) / static_cast<double>(diverged.count), 7.0, 0.4);
  // Second field of the lower row.
  EXPECT_GT(diverged.left, picture->width / 4);
  EXPECT_LT(diverged.right, picture->width / 2 + 30);
}

TEST(MapFigure, DrawsWhatChai3dAllows) {
  constexpr ImU32 kChai3d = IM_COL32(0, 110, 255, 255);
  StabilityMap map = map_of(1);
  const std::vector<MapMetrics> cells(map.cell_count());
  EXPECT_EQ(extent_of(*draw_map(map, cells), kChai3d).count, 0U);
  map.scene.x().device.chai3d_stiffness_n_per_m = 1e4;
  map.scene.x().device.chai3d_damping_n_s_per_m = 5.0;
  const auto picture = draw_map(map, cells);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const Extent field = extent_of(*picture, verdict_area(Verdict::kSettled));
  const int middle = (field.left + field.right) / 2;  // 1e4 N/m, the middle of 1e3 to 1e5
  const test::Colour blue{0, 110, 255};
  const int height = picture->height;
  EXPECT_GT(test::count_pixels(*picture, blue, middle - 9, kLegend, middle + 9, height), 300);
  EXPECT_GT(test::count_pixels(*picture, blue, 0, 60, picture->width, kLegend), 10) << "a key";
  const std::size_t theory = map_bounds(map).size();
  map.scene.x().device.chai3d_stiffness_n_per_m = 1e6;
  EXPECT_EQ(map_bounds(map).size(), theory - 1) << "beyond the axis";
}

// With virtual damping the rule lies above the limit, so only the rule is drawn to the right of the
// limit.
TEST(MapFigure, DrawsTheExactLimitAndTheRuleAsAThinnerLine) {
  StabilityMap map;
  map.scene.x().device.delay_ticks = 1;
  map.scene.x().walls = {{0.05, 1000.0, 0.0}};
  map.algorithms = {find_algorithm("none").value()};
  map.x = {find_scene_number(map.scene, "wall.stiffness_n_per_m").value(), 500.0, 5e4, 40, true};
  map.y = {find_scene_number(map.scene, "wall.damping_n_s_per_m").value(), 0.5, 20.0, 60, false};
  const auto picture = draw_map(map, std::vector<MapMetrics>(map.cell_count()));
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const Extent limit = extent_of(*picture, IM_COL32(120, 40, 150, 255));
  const Extent cells = extent_of(*picture, verdict_area(Verdict::kSettled));
  EXPECT_GT(limit.count, 500U);
  const double best = 0.1544 * 5e4;  // K T²/m at B T/m = 0.4
  const double share = (std::log(best / 500.0) / std::log(100.0) * 39.0 + 0.5) / 40.0;
  EXPECT_NEAR(limit.right, cells.left + share * (cells.right - cells.left), 8.0);
  const test::Colour rule{165, 90, 190};
  const int thin = test::count_pixels(*picture, rule, limit.right + 5, kLegend, cells.right,
                                      picture->height, 60);
  EXPECT_GT(thin, 100);
}

TEST(MapFigure, ColoursTellHowFarItSwings) {
  EXPECT_NE(verdict_area(Verdict::kSettled), oscillating_colour(1.01e-4));
  EXPECT_NE(oscillating_colour(1e-4), oscillating_colour(1e-3));
  EXPECT_NE(oscillating_colour(1e-3), oscillating_colour(1e-2));
  EXPECT_EQ(oscillating_colour(0.1), oscillating_colour(0.9)) << "the hottest there is";
  MapMetrics figures;
  figures.verdict = Verdict::kOscillating;
  figures.tail_peak_to_peak_m = 2e-3;
  EXPECT_EQ(colour_of(figures), oscillating_colour(2e-3));
  figures.verdict = Verdict::kBuzzing;
  EXPECT_NE(colour_of(figures), verdict_area(Verdict::kSettled));
  EXPECT_NE(colour_of(figures), oscillating_colour(1e-4));
}

TEST(MapFigure, IsTheSameInVectorFiles) {
  const StabilityMap map = map_of(2);
  std::vector<MapMetrics> cells = half_and_half(map);
  cells.insert(cells.end(), cells.rbegin(), cells.rend());
  test::expect_same_in_vector_files([&](Ink ink) { return draw_map(map, cells, {.ink = ink}); });
}

TEST(MapFigure, CellsTouchEachOtherInVectorFiles) {
  if (!test::can_draw_vector_files()) GTEST_SKIP() << test::kNoPrograms;
  const StabilityMap map = map_of(1);
  const auto draw = [&](Ink ink) { return draw_map(map, half_and_half(map), {.ink = ink}); };
  const auto pixels =
      static_cast<double>(extent_of(*draw(Ink::kPixels), verdict_area(Verdict::kSettled)).count);
  for (const char* ending : {".svg", ".pdf"}) {
    const file::Picture drawn = test::FigureFile(draw, ending).drawn();
    const auto count = static_cast<double>(extent_of(drawn, verdict_area(Verdict::kSettled)).count);
    EXPECT_NEAR(count / pixels, 1.0, 0.01) << ending;
  }
}

}  // namespace
}  // namespace hapticwall::draw
