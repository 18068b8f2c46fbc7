// The table "Friction and delay" of docs/algorithms/README.md, row by row, from the program's own
// boundaries.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall {
namespace {

using ::testing::Contains;

constexpr double kMaxFrictionN = 0.2;
constexpr double kMaxDelayTicks = 28.0;
constexpr double kMillinewtonsPerNewton = 1000.0;

// One boundary per algorithm.
std::vector<Boundary> boundaries(const std::string& scene, const char* key, double high,
                                 std::size_t count) {
  BoundaryPlan plan;
  plan.scene = file::load_scene(scene)->scene;
  for (std::size_t i = 0; i < algorithms().size(); ++i) plan.algorithms.push_back(i);
  plan.along = {find_scene_number(plan.scene, key).value(), 0.0, high, count, false};
  return find_boundaries(plan);
}

// The friction beyond which no value of the scan fails, rounded up.
std::string friction_text(const Boundary& friction) {
  const double failed_n = friction.failed.last.value_or(0.0);
  if (failed_n >= kMaxFrictionN) return "-";
  return fmt::format("{:.0f} mN", std::ceil(kMillinewtonsPerNewton * failed_n));
}

// The delay up to which no value of the scan fails.
std::string delay_text(const Boundary& delay) {
  if (!delay.failed.first) return fmt::format("≥ {}", kMaxDelayTicks);
  return *delay.failed.first > 0.0 ? fmt::format("{:.0f}", *delay.failed.first - 1.0) : "-";
}

TEST(FrictionAndDelay, TheTableOfThePageIsThatOfTheProgram) {
  std::vector<std::vector<std::string>> cells(algorithms().size());
  for (const char* scene : {"press", "tap", "tap-slow", "light"}) {
    const auto friction = boundaries(scene, "device.friction_n", kMaxFrictionN, 201);
    const auto delay = boundaries(scene, "device.delay_ticks", kMaxDelayTicks, 29);
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i].push_back(friction_text(friction[i]) + ", " + delay_text(delay[i]));
  }
  const auto page = test::lines_of(test::data_folder() + "/../docs/algorithms/README.md");
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_THAT(page, Contains(fmt::format("| [{0}]({0}.md) | {1} |", algorithms()[i].name,
                                           fmt::join(cells[i], " | "))));
}

}  // namespace
}  // namespace hapticwall
