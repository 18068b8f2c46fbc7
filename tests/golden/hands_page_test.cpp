// The tables of docs/hands.md, row by row, from the program's own runs and boundaries.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/file/scene/hand_description.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "core/study/hands_study.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::hands_page {
namespace {

using ::testing::Contains;

using Cells = std::vector<std::vector<std::string>>;

constexpr double kMaxFrictionN = 0.2;
constexpr double kMaxDelayTicks = 28.0;

std::vector<std::size_t> all_algorithms() {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < algorithms().size(); ++i) indices.push_back(i);
  return indices;
}

void expect_rows(const Cells& cells) {
  const auto page = test::lines_of(test::data_folder() + "/../docs/hands.md");
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_THAT(page, Contains(fmt::format("| [{0}](algorithms/{0}.md) | {1} |",
                                           algorithms()[i].name, fmt::join(cells[i], " | "))));
}

TEST(HandsPage, TheVerdictsAreThoseOfTheProgram) {
  Cells cells(algorithms().size());
  for (const char* scene : {"press", "tap", "tap-slow", "light"}) {
    HandsPlan plan;
    plan.scene = file::load_scene(scene)->scene;
    for (const file::BuiltinHand& hand : file::builtin_hands())
      plan.hands.push_back({hand.name, file::load_hand_description(hand.name)->hand});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      plan.algorithms = {i};
      const HandsRow row = study_hands(plan).front();
      cells[i].push_back(fmt::format("{} of {}, {}", row.good(), row.runs.size(),
                                     verdict_name(row.runs[row.worst()].verdict)));
    }
  }
  expect_rows(cells);
}

// Of each algorithm, by docs/algorithms/README.md: the delay up to which no value fails, in ticks.
double delay_margin(const Boundary& delay) {
  return delay.failed.first ? std::round(*delay.failed.first) - 1.0 : kMaxDelayTicks;
}

std::string delay_text(double ticks) {
  if (ticks < 0.0) return "-";
  return fmt::format("{}{:.0f}", ticks >= kMaxDelayTicks ? "≥ " : "", ticks);
}

// The friction beyond which none fails, in mN rounded up; infinite if the largest fails.
double needed_friction(const Boundary& friction) {
  const double failed_n = friction.failed.last.value_or(0.0);
  if (failed_n >= kMaxFrictionN) return std::numeric_limits<double>::infinity();
  return std::ceil(1000.0 * failed_n);
}

std::string friction_text(double mn) { return std::isinf(mn) ? "-" : fmt::format("{:.0f} mN", mn); }

std::vector<Boundary> boundaries_of(const Scene& scene, const char* key, double high,
                                    std::size_t count) {
  BoundaryPlan plan;
  plan.scene = scene;
  plan.algorithms = all_algorithms();
  plan.along = {find_scene_number(scene, key).value(), 0.0, high, count, false};
  return find_boundaries(plan);
}

// "own; worst; median" of each algorithm. `worst_first`: the smallest margin is the worst.
void add_margins(const char* scene_name, const char* key, double high, std::size_t count,
                 double (*margin)(const Boundary&), std::string (*text)(double), bool worst_first,
                 Cells& cells) {
  const Scene scene = file::load_scene(scene_name)->scene;
  const auto own = boundaries_of(scene, key, high, count);
  std::vector<std::vector<double>> margins(cells.size());
  for (const file::BuiltinHand& hand : file::builtin_hands()) {
    const Scene with = file::with_hand(scene, file::load_hand_description(hand.name)->hand);
    const auto found = boundaries_of(with, key, high, count);
    for (std::size_t i = 0; i < cells.size(); ++i) margins[i].push_back(margin(found[i]));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::ranges::sort(margins[i]);
    const double worst = worst_first ? margins[i].front() : margins[i].back();
    cells[i].push_back(fmt::format("{}; {}; {}", text(margin(own[i])), text(worst),
                                   text(margins[i][margins[i].size() / 2])));
  }
}

TEST(HandsPage, TheMarginsAreThoseOfTheProgram) {
  Cells cells(algorithms().size());
  for (const char* scene : {"press", "tap"})
    add_margins(scene, "device.delay_ticks", kMaxDelayTicks, 29, delay_margin, delay_text, true,
                cells);
  add_margins("press", "device.friction_n", kMaxFrictionN, 201, needed_friction, friction_text,
              false, cells);
  expect_rows(cells);
}

}  // namespace
}  // namespace hapticwall::hands_page
